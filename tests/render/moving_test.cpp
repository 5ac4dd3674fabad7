// Things that move in a scene: what the sonar hears is where they are at the ping, with their shadows and
// mirror images.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/scene/scene.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using namespace test;

constexpr double range = 20;
constexpr std::size_t bins = 400;
constexpr double bin = range / bins;

const std::string box_name = "box";

/// A floor 2 m below and a wall 15 m ahead that stay, and a box of 1 m about its own origin.
std::shared_ptr<const Scene> scene_with_box() {
    const std::vector<Mesh> meshes{floor_at(-2, 30), wall_at(15, 30, -2, 6), box("box", {}, {1, 1, 1})};
    return Scene::from_meshes(meshes, {}, std::span(&box_name, 1));
}

Situation with_box_at(const Pose& pose, bool objects = false) {
    Situation situation;
    situation.movers = {pose};
    situation.objects = objects;
    return situation;
}

/// Range in m of the leading edge of the first bin of the beam that holds anything.
double first_echo(const Echogram& e, std::size_t beam) {
    const auto values = e.beam(beam);
    const auto first = std::ranges::find_if(values, [](float v) { return v > 0; });
    return static_cast<double>(first - values.begin()) * bin;
}

TEST(Moving, AnObjectThatMovesAwayIsHeardFartherAway) {
    Renderer renderer(scene_with_box(), water_of(1500), boxes());
    const Shot shot = fan(30, 2, 15, bins, range);
    const Echogram near = renderer.render(shot, with_box_at({{6.5, 0, 0}, {}}));
    const Echogram far = renderer.render(shot, with_box_at({{9.5, 0, 0}, {}}));
    EXPECT_NEAR(first_echo(near, 7), 6, bin);
    EXPECT_NEAR(first_echo(far, 7), 9, bin);
    EXPECT_NEAR(near.truth[7].axis_range, 6, 1e-4);
    EXPECT_NEAR(far.truth[7].axis_range, 9, 1e-4);
    EXPECT_NEAR(first_echo(far, 0), 15 / std::cos(shot.bearings[0] + shot.beam_width / 2), 2 * bin)
        << "what stands still stands still";
}

TEST(Moving, TheShadowMovesToo) {
    Renderer renderer(scene_with_box(), water_of(1500), boxes());
    const Shot shot = fan(60, 2, 60, bins, range);
    for (const double y : {-3.0, 0.0, 2.5}) {
        const Echogram e = renderer.render(shot, with_box_at({{8, y, 0}, {}}, true));
        for (std::size_t beam = 0; beam < shot.bearings.size(); ++beam) {
            const double at_box =
                -8 * std::tan(shot.bearings[beam]) - y;  // m beside its middle; clockwise is -y
            const double to_wall = 15 / std::cos(shot.bearings[beam]);
            const auto level = e.beam(beam)[static_cast<std::size_t>((to_wall + 0.01) / bin)];
            if (std::abs(at_box) < 0.4) {
                EXPECT_EQ(level, 0) << "behind the box, " << shot.bearings[beam];
            } else if (std::abs(at_box) > 1.2) {
                EXPECT_GT(level, 0) << "beside the box, " << shot.bearings[beam];
            }
        }
    }
}

TEST(Moving, ATurnedObjectIsSeenFromItsOtherSide) {
    Renderer renderer(scene_with_box(), water_of(1500), boxes());
    const Shot shot = fan(4, 2, 1, bins, range);
    const Echogram e = renderer.render(shot, with_box_at({{8, 0, 0}, from_rpy(0, 0, deg_to_rad(45))}));
    EXPECT_NEAR(e.truth[0].nearest_range, 8 - std::sqrt(0.5), 0.05) << "an edge is nearest now";
}

TEST(Moving, IsTheSameAsASceneThatWasMadeSo) {
    const Pose place{{7, 1, -0.5}, from_rpy(0.2, -0.1, 0.7)};
    Mesh moved = box("box", {}, {1, 1, 1});
    for (Vec3& p : moved.positions) p = place * p;
    for (Vec3& n : moved.normals) n = rotate(place.orientation, n);
    RendererOptions options;
    options.effects.set(Effect::speckle, false).set(Effect::noise, false);
    Renderer still(scene_of({floor_at(-2, 30), wall_at(15, 30, -2, 6), moved}), water_of(1500), options);
    Renderer moving(scene_with_box(), water_of(1500), options);
    const Shot shot = fan(60, 10, 60, bins, range);
    const Echogram a = still.render(shot, Pose{}), b = moving.render(shot, with_box_at(place));
    double difference = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        difference += std::abs(static_cast<double>(a.values[i]) - static_cast<double>(b.values[i]));
    EXPECT_LT(difference, 0.01 * total_power(a));
}

TEST(Moving, NamesTheObjectWhereItIs) {
    Renderer renderer(scene_with_box(), water_of(1500), boxes());
    const Shot shot = fan(30, 2, 15, bins, range);
    const Echogram e = renderer.render(shot, with_box_at({{9.5, 0, 0}, {}}, true));
    const std::uint16_t object = e.objects[7 * bins + static_cast<std::size_t>(9.02 / bin)];
    ASSERT_NE(object, 0);
    EXPECT_EQ(renderer.scene().objects()[object - 1U], "box");
}

TEST(Moving, TheMirrorImageInTheSurfaceMovesToo) {
    RendererOptions options;
    options.effects = Effects::none().set(Effect::spreading).set(Effect::multipath);
    options.surface = WaterSurface{2, 0};
    Renderer renderer(scene_with_box(), water_of(1500), options);
    const Shot shot = fan(10, 90, 1, bins, range);
    for (const double x : {5.0, 9.0}) {
        const Echogram e = renderer.render(shot, with_box_at({{x, 0, 0}, {}}));
        options.effects.set(Effect::multipath, false);
        Renderer direct(scene_with_box(), water_of(1500), options);
        const Echogram d = direct.render(shot, with_box_at({{x, 0, 0}, {}}));
        options.effects.set(Effect::multipath);
        // There and back by the surface 2 m above: half of direct and mirrored way together.
        const double mirrored = (std::hypot(x - 0.5, 4) + x - 0.5) / 2;
        double more = 0;
        for (double r = mirrored - 0.7; r < mirrored + 0.7; r += bin)
            more += e.values[static_cast<std::size_t>(r / bin)] - d.values[static_cast<std::size_t>(r / bin)];
        EXPECT_GT(more, 0) << x;
    }
}

TEST(Moving, HidesATargetOfDeclaredStrengthBehindIt) {
    const std::vector<Mesh> meshes{floor_at(-2, 30), box("box", {}, {1, 1, 1})};
    const std::vector<PointTarget> targets{{"ball", {12, 0, 0}, 0}};
    RendererOptions options;
    options.effects = Effects::none().set(Effect::spreading);
    Renderer renderer(Scene::from_meshes(meshes, targets, std::span(&box_name, 1)), water_of(1500), options);
    const Shot shot = fan(4, 2, 1, bins, range);
    const auto at_ball = [&](const Pose& pose) {
        return renderer.render(shot, with_box_at(pose)).values[static_cast<std::size_t>(12.01 / bin)];
    };
    EXPECT_GT(at_ball({{6, 3, 0}, {}}), 0);
    EXPECT_EQ(at_ball({{6, 0, 0}, {}}), 0);
    EXPECT_GT(at_ball({{14, 0, 0}, {}}), 0);
}

TEST(Moving, DoesNotRememberWhereThingsWere) {
    Renderer renderer(scene_with_box(), water_of(1500));
    const Shot shot = fan(30, 10, 15, bins, range);
    const Echogram first = renderer.render(shot, with_box_at({{6, 0, 0}, {}}));
    renderer.render(shot, with_box_at({{100, 50, 2}, {}}));
    EXPECT_EQ(renderer.render(shot, with_box_at({{6, 0, 0}, {}})).values, first.values);
}

TEST(Moving, RefusesPosesThatAreNone) {
    Renderer renderer(scene_with_box(), water_of(1500));
    const Shot shot = fan(30, 10, 15, bins, range);
    Situation two = with_box_at({});
    two.movers.push_back({});
    EXPECT_THROW(renderer.render(shot, two), std::invalid_argument);
    EXPECT_THROW(renderer.render(shot, with_box_at({{0, 0, 0}, {2, 0, 0, 0}})), std::invalid_argument);
}

}  // namespace
}  // namespace echoloop
