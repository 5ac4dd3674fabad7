// The two sonars of Cerqueira et al. 2016, its three channels, determinism, and shots that must be refused.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

std::shared_ptr<const Scene> tank() {
    return test::scene_of({test::floor_at(-5, 60), test::wall_at(25, 20, -5, 3),
                           test::box("box", {12, 3, -4}, {2, 2, 2}, 0.5),
                           test::sphere({10, -3, -4}, 0.7, 24)});
}

TEST(PaperSonars, ForwardLooking) {
    Renderer renderer(tank(), test::water_of(1500), test::boxes());
    const Shot shot = test::forward_looking();
    const Echogram e = renderer.render(shot, {});
    EXPECT_EQ(e.beams(), 256U);
    EXPECT_EQ(e.values.size(), 256U * 500U);
    EXPECT_EQ(e.truth.size(), 256U);
    EXPECT_EQ(e.shot, shot);
    EXPECT_EQ(e.sound_speed, 1500);
    EXPECT_GT(test::total_power(e), 0);
    for (const float v : e.values) EXPECT_TRUE(std::isfinite(v) && v >= 0);
}

// 3 x 35 deg in steps of 1.8 deg over a full turn: walls of a square tank stand at 8 m / cos.
TEST(PaperSonars, ScanningHeadMapsASquareTank) {
    std::vector<Mesh> walls;
    for (int side = 0; side < 4; ++side) {
        Mesh wall = test::wall_at(8, 8, -10, 10);
        for (Vec3& p : wall.positions) p = rotate(axis_angle({0, 0, 1}, side * std::numbers::pi / 2), p);
        walls.push_back(wall);
    }
    Renderer renderer(test::scene_of(walls), test::water_of(1500), test::boxes());
    Shot shot = test::scanning();
    shot.bin_interval = 2 * 15.0 / 1500 / 500;
    for (int step = 0; step < 200; ++step) {
        shot.pan = deg_to_rad(1.8 * step);
        shot.ping = static_cast<std::uint64_t>(step);
        const Echogram e = renderer.render(shot, {});
        const double off_axis = std::remainder(shot.pan, std::numbers::pi / 2);
        const double wall = 8 / std::cos(off_axis);
        EXPECT_NEAR(e.truth[0].axis_range, wall, 0.05) << step;  // in a corner, between two pixels
        // The strongest bin lies between the nearest corner of the beam and the wall at its far edge.
        const double half_beam = wall * std::abs(std::tan(off_axis)) * shot.beam_width / 2;
        EXPECT_NEAR(e.bin_range(test::strongest_bin(e.beam(0))), wall, half_beam + 0.25) << step;
    }
}

TEST(PaperSonars, CerqueiraIsWithin0And1) {
    Renderer renderer(tank(), test::water_of(1500), {.rule = EchoRule::cerqueira2016});
    float largest = 0;
    for (const float v : renderer.render(test::forward_looking(), {}).values) {
        EXPECT_GE(v, 0);
        largest = std::max(largest, v);
    }
    EXPECT_GT(largest, 0.5);
    EXPECT_LE(largest, 1);
}

TEST(PaperSonars, ThreeChannels) {
    Renderer renderer(test::scene_of({test::wall_at(10, 5, -5, 5)}), test::water_of(1500), test::boxes());
    const Shot shot = test::fan(60, 20, 64, 500, 50);
    const ChannelImage image = renderer.render_channels(shot, {});
    ASSERT_EQ(image.range.size(), image.width * image.height);
    ASSERT_EQ(image.intensity.size(), image.range.size());
    ASSERT_EQ(image.bearing.size(), image.range.size());
    std::size_t seen = 0;
    for (std::size_t i = 0; i < image.range.size(); ++i) {
        const bool first = i % image.width == 0;
        EXPECT_TRUE(first || image.bearing[i] > image.bearing[i - 1]);
        if (std::isnan(image.range[i])) {
            EXPECT_EQ(image.intensity[i], 0);
            continue;
        }
        ++seen;
        EXPECT_NEAR(image.intensity[i], 10 / image.range[i], 1e-4);  // cos(incidence) on a wall 10 m away
    }
    EXPECT_GT(seen, image.range.size() / 2);
    const std::size_t middle = image.height / 2 * image.width + image.width / 2;
    EXPECT_NEAR(image.range[middle], 10, 0.01);
    EXPECT_NEAR(image.bearing[middle], 0, 0.01);
}

TEST(Determinism, SamePingSameBytes) {
    const auto scene = tank();
    Shot shot = test::forward_looking();
    shot.ping = 42;
    Renderer first(scene, {}), second(scene, {});
    first.render(test::scanning(), {});  // what came before does not matter
    const Echogram a = first.render(shot, {}), b = second.render(shot, {}), c = first.render(shot, {});
    EXPECT_EQ(std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(float)), 0);
    EXPECT_EQ(std::memcmp(a.values.data(), c.values.data(), a.values.size() * sizeof(float)), 0);
    EXPECT_EQ(std::memcmp(a.truth.data(), b.truth.data(), a.truth.size() * sizeof(BeamTruth)), 0);
}

TEST(BadShot, IsRefusedByName) {
    const auto changed = [](const auto& change) {
        Shot shot = test::fan(60, 20, 16, 100, 20);
        change(shot);
        return shot;
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::pair<Shot, const char*> cases[] = {
        {changed([](Shot& s) { s.bearings.clear(); }), "bearings"},
        {changed([](Shot& s) { s.bearings.resize(5000); }), "bearings"},
        {changed([&](Shot& s) { s.bearings[3] = nan; }), "bearings"},
        {changed([](Shot& s) { std::swap(s.bearings[0], s.bearings[1]); }), "bearings"},
        {changed([](Shot& s) { s.bearings.back() = 4; }), "bearings"},
        {changed([](Shot& s) { s.beam_width = 0; }), "beam_width"},
        {changed([](Shot& s) { s.fan_height = 3; }), "fan_height"},
        {changed([&](Shot& s) { s.pan = nan; }), "pan"},
        {changed([](Shot& s) { s.tilt = 2; }), "tilt"},
        {changed([](Shot& s) { s.bins = 0; }), "bins"},
        {changed([](Shot& s) { s.bins = std::size_t{1} << 60; }), "bins"},
        {changed([](Shot& s) { s.first_bin_time = -1; }), "first_bin_time"},
        {changed([](Shot& s) { s.bin_interval = 0; }), "bin_interval"},
        {changed([](Shot& s) { s.frequency = 0; }), "frequency"},
        {changed([&](Shot& s) { s.source_level = nan; }), "source_level"},
        {changed([](Shot& s) { s.pulse_length = -1; }), "pulse_length"}};
    Renderer renderer(test::scene_of({test::wall_at(10, 5, -5, 5)}), {}, test::boxes());
    for (const auto& [shot, member] : cases) try {
            renderer.render(shot, {});
            ADD_FAILURE() << member;
        } catch (const std::invalid_argument& error) {
            EXPECT_NE(std::string(error.what()).find(member), std::string::npos) << error.what();
        }
    const Shot good = test::fan(60, 20, 16, 100, 20);
    EXPECT_THROW(renderer.render(good, {{nan, 0, 0}, {}}), std::invalid_argument);
    EXPECT_THROW(renderer.render(good, {{}, {0, 0, 0, 0}}), std::invalid_argument);
    EXPECT_GT(test::total_power(renderer.render(good, {})), 0);  // it still works
}

TEST(BadOptions, AreRefused) {
    const auto scene = test::scene_of({test::wall_at(10, 5, -5, 5)});
    EXPECT_THROW(Renderer(nullptr, {}), std::invalid_argument);
    EXPECT_THROW(Renderer(scene, test::water_of(3)), std::invalid_argument);
    EXPECT_THROW(Renderer(scene, {}, {.columns_per_beam = 0}), std::invalid_argument);
    EXPECT_THROW(Renderer(scene, {}, {.pixel_density = 1e9}), std::invalid_argument);
    EXPECT_THROW(Renderer(scene, {}, {.context = "glx"}), std::invalid_argument);
}

}  // namespace
}  // namespace echoloop
