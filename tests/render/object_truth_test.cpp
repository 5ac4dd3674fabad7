// Echogram::objects against scenes whose ranges are known: the object of a bin is the one that stands there.
#include <gtest/gtest.h>

#include "tests/render/meshes.h"
#include "tests/render/ping_motions.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using namespace test;

constexpr double range = 20;
constexpr std::size_t bins = 200;  // 0.1 m each

/// 1: a floor 3 m below; 2: a wall 12 m ahead; 3: a box to starboard whose face is 6 m ahead.
std::shared_ptr<const Scene> room() {
    return scene_of({floor_at(-3, 30), wall_at(12, 30, -3, 5), box("box", {6.5, -2, 0}, {1, 2, 2})});
}

Situation with_objects(const Pose& pose = {}) {
    Situation situation(pose);
    situation.objects = true;
    return situation;
}

std::uint16_t object_at(const Echogram& e, std::size_t beam, double metres) {
    return e.objects[beam * e.shot.bins + static_cast<std::size_t>(metres / range * bins)];
}

std::size_t beam_at(const Shot& shot, double bearing) {
    const auto after = std::ranges::lower_bound(shot.bearings, bearing);
    return static_cast<std::size_t>(after - shot.bearings.begin());
}

/// Of the bin with the most power in the beam.
std::uint16_t strongest_object(const Echogram& e, std::size_t beam) {
    const auto values = e.beam(beam);
    const auto strongest = std::ranges::max_element(values) - values.begin();
    return e.objects[beam * e.shot.bins + static_cast<std::size_t>(strongest)];
}

TEST(ObjectTruth, NamesWhatStandsAtTheRangeOfABin) {
    Renderer renderer(room(), water_of(1500), boxes());
    const Shot shot = fan(90, 10, 90, bins, range);
    const Echogram e = renderer.render(shot, with_objects());
    ASSERT_EQ(e.objects.size(), e.values.size());
    for (const double bearing : {-0.6, -0.2, 0.0}) {
        const std::size_t beam = beam_at(shot, bearing);
        EXPECT_EQ(object_at(e, beam, 12.05 / std::cos(shot.bearings[beam])), 2) << bearing;
        EXPECT_EQ(object_at(e, beam, 10.5), 0) << "there is only water before the wall, at " << bearing;
        EXPECT_EQ(strongest_object(e, beam), 2);
    }
    const std::size_t at_box = beam_at(shot, std::atan2(2, 6));  // clockwise is starboard, -y
    EXPECT_EQ(object_at(e, at_box, 6.05 / std::cos(shot.bearings[at_box])), 3);
    EXPECT_EQ(object_at(e, at_box, 12.1 / std::cos(shot.bearings[at_box])), 0) << "the box hides the wall";
}

/// The water's steps, which stand behind the bins of the levels, have no place behind these.
TEST(ObjectTruth, IsThatOfARestingFanWhereItTurnsInWaterThatSendsSoundBack) {
    RendererOptions options = patterned();
    options.effects.set(Effect::reverberation);
    Water water = water_of(1500);
    water.scattering = {{0, -75}};  // dB, of a clear sea
    Renderer renderer(room(), water, options);
    const Shot shot = fan(90, 10, 90, bins, range);
    const Echogram still = renderer.render(shot, with_objects());
    Situation turning = with_objects();
    turning.turning.z = deg_to_rad(5);  // 0.1 deg in 20 ms
    for (int ping = 0; ping < 5; ++ping) {
        const Echogram e = renderer.render(shot, turning);
        ASSERT_EQ(e.objects.size(), still.objects.size());
        std::size_t others = 0;
        for (std::size_t i = 0; i < e.objects.size(); ++i) others += e.objects[i] != still.objects[i];
        EXPECT_LT(others, e.objects.size() / 50) << "a bin or two at the box's edges";
    }
}

TEST(ObjectTruth, NamesTheFloorBelowADippedFan) {
    Renderer renderer(room(), water_of(1500), boxes());
    Shot shot = fan(60, 20, 30, bins, range);
    shot.tilt = deg_to_rad(-30);
    const Echogram e = renderer.render(shot, with_objects());
    EXPECT_EQ(object_at(e, 5, 6), 1);
    EXPECT_EQ(strongest_object(e, 5), 1);
}

TEST(ObjectTruth, HearsThroughSideLobesWhatTheLevelsHear) {
    RendererOptions options = boxes();
    options.effects.set(Effect::beam_pattern).set(Effect::side_lobes);
    Renderer renderer(room(), water_of(1500), options);
    const Echogram e = renderer.render(fan(60, 10, 60, bins, range), with_objects());
    EXPECT_EQ(object_at(e, 30, 3.05), 1) << "the first bottom return comes from below";
    for (std::size_t i = 0; i < e.values.size(); ++i) EXPECT_EQ(e.values[i] > 0, e.objects[i] != 0) << i;
}

TEST(ObjectTruth, LeavesOutWhatTheNoiseHides) {
    RendererOptions loud = boxes();
    loud.effects.set(Effect::noise);
    Renderer renderer(room(), water_of(1500), loud);
    Shot shot = fan(90, 10, 90, bins, range);
    shot.receiver.self_noise = 400;
    const Echogram e = renderer.render(shot, with_objects());
    for (const std::uint16_t object : e.objects) ASSERT_EQ(object, 0);
}

TEST(ObjectTruth, CostsNothingAndChangesNothingUnlessAskedFor) {
    Renderer renderer(room(), water_of(1500));
    const Shot shot = fan(90, 10, 90, bins, range);
    const Echogram plain = renderer.render(shot, Pose{}), asked = renderer.render(shot, with_objects());
    EXPECT_TRUE(plain.objects.empty());
    EXPECT_EQ(plain.values, asked.values);
}

}  // namespace
}  // namespace echoloop
