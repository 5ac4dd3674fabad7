// How fast what a beam hears comes nearer (V38 of the reference values), as a Doppler log asks for it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/meshes.h"
#include "tests/render/ping_motions.h"

namespace echoloop {
namespace {

using test::moving;
using test::patterned;

constexpr double c = 1500;

/// Four beams of 4 deg, 30 deg off the vertical, ahead to port and starboard and astern.
Shot janus(double depth) {
    Shot shot = test::fan(4, 4, 4, 200, 1.5 * depth);
    shot.bearings = {deg_to_rad(-135), deg_to_rad(-45), deg_to_rad(45), deg_to_rad(135)};
    shot.sides.assign(4, {deg_to_rad(60), 200});
    shot.beam_width = shot.fan_height = deg_to_rad(4);
    shot.horizontal = shot.vertical = {ApertureShape::piston, 2};
    shot.velocities = true;
    return shot;
}

// V38: 2 v f sin 30 / c, so v sin 30 along a beam, times cos 45 here.
TEST(ClosingSpeeds, OfFourBeamsOverAFlatFloor) {
    constexpr double depth = 10;
    Renderer renderer(test::scene_of({test::floor_at(-depth, 60)}), test::water_of(c), patterned());
    Shot shot = janus(depth);
    for (const Vec3 velocity : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0.3, -0.2, 0.1}}) {
        std::vector<double> power(4), mean(4), square(4);
        for (shot.ping = 0; shot.ping < 16; ++shot.ping) {
            const Echogram e = renderer.render(shot, moving(velocity));
            ASSERT_EQ(e.velocities.size(), e.values.size());
            for (std::size_t i = 0; i < e.values.size(); ++i)
                if (e.values[i] > 0) {
                    const auto beam = i / shot.bins;
                    const double p = e.values[i], v = e.velocities[i].mean;
                    power[beam] += p, mean[beam] += p * v;
                    square[beam] += p * (v * v + std::pow(e.velocities[i].spread, 2));
                }
        }
        for (std::size_t beam = 0; beam < 4; ++beam) {
            const double b = shot.bearings[beam], level = std::sin(deg_to_rad(30)),
                         down = std::cos(deg_to_rad(30));
            const Vec3 axis{level * std::cos(b), -level * std::sin(b), -down};
            const double along = mean[beam] / power[beam];
            EXPECT_NEAR(along, dot(axis, velocity), 0.01 * norm(velocity)) << beam;
            const double spread = std::sqrt(square[beam] / power[beam] - along * along);
            // A piston's beam of 4 deg has about 1.7 deg of standard deviation along one axis; what lies off
            // the beam's line is faster or slower by that times the velocity beside it.
            const double beside = norm(velocity - dot(axis, velocity) * axis);
            EXPECT_GT(spread, 0.5 * deg_to_rad(1.7) * beside);
            EXPECT_LT(spread, 2 * deg_to_rad(1.7) * beside);
        }
    }
    EXPECT_TRUE(renderer.render(test::fan(20, 20, 40, 400, 22), moving({1, 0, 0})).velocities.empty());
    for (const ClosingSpeed& speed : renderer.render(shot, {}).velocities)
        if (!std::isnan(speed.mean)) {
            EXPECT_EQ(speed.mean, 0);
            EXPECT_EQ(speed.spread, 0);
        }
}

// A box that comes nearer in front of a wall that stands.
TEST(ClosingSpeeds, OfThingsThatMove) {
    const std::string name = "box";
    const std::vector<Mesh> meshes{test::wall_at(15, 30, -2, 6), test::box("box", {}, {1, 1, 1})};
    Renderer renderer(Scene::from_meshes(meshes, {}, std::span(&name, 1)), test::water_of(c), patterned());
    Shot shot = test::fan(30, 5, 15, 400, 20);
    shot.velocities = true;
    Situation situation = moving({0.5, 0, 0});
    situation.movers = {{{8.5, 0, 0}, {}}};
    situation.mover_motions = {{{-0.7, 0, 0}, {}}};
    const Echogram e = renderer.render(shot, situation);
    const auto middle = std::span(e.velocities).subspan(7 * shot.bins, shot.bins);
    EXPECT_NEAR(middle[static_cast<std::size_t>(8.0 / 0.05)].mean, 1.2, 0.01) << "at 8 m";
    const auto edge = std::span(e.velocities).first(shot.bins);
    const double ahead = std::cos(shot.bearings[0]);
    EXPECT_NEAR(edge[static_cast<std::size_t>(15 / ahead / 0.05)].mean, 0.5 * ahead, 0.01);
}

}  // namespace
}  // namespace echoloop
