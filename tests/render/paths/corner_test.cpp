// Corners send sound back to where it came from: at the corner's range, with the level of a mirror or of a
// plate.
#include <gtest/gtest.h>

#include "tests/render/paths/path_rooms.h"

namespace echoloop {
namespace {

constexpr double reflection = 0.9;
const Effects boxes = test::without({Effect::beam_pattern});

Mesh mirror(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    return test::smooth(test::quad("wall", a, b, c, d), reflection);
}

/// A wall at x that faces -x, one at y = -4 that faces +y; their edge is plumb.
std::vector<Mesh> two_walls(double x = 10, double height = 30) {
    return {mirror({x, 20, -height}, {x, -4, -height}, {x, -4, height}, {x, 20, height}),
            mirror({-10, -4, -height}, {-10, -4, height}, {x, -4, height}, {x, -4, -height})};
}

std::vector<TargetEcho> echoes_of(const std::vector<Mesh>& meshes, const Pose& pose,
                                  std::optional<WaterSurface> surface, int faces,
                                  const Shot& shot = test::wide_beam(60, 60)) {
    auto all = test::trace(test::scene_of(meshes), surface, boxes, shot, pose).targets;
    std::erase_if(all, [faces](const TargetEcho& echo) { return echo.bounces != faces; });
    return all;
}

TEST(Corners, TwoWallsAtARightAngleEchoFromTheirEdge) {
    const Pose pose{{0, 0, -3}, {}};
    const auto echoes = echoes_of(two_walls(), pose, {}, 2);
    ASSERT_EQ(echoes.size(), 1U);
    const double range = std::hypot(10, 4);
    EXPECT_NEAR(echoes[0].range, range, 1e-4);
    EXPECT_NEAR(rad_to_deg(echoes[0].bearing), rad_to_deg(std::atan2(4, 10)), 1e-3);
    // The sonar's own image at twice the range, seen in two mirrors.
    EXPECT_NEAR(test::db(echoes[0].power), 200 - 20 * std::log10(2 * range) + 40 * std::log10(reflection),
                0.1);
}

TEST(Corners, ThreeWallsEchoFromTheirVertex) {
    auto meshes = two_walls();
    meshes.push_back(mirror({-10, -4, -9}, {10, -4, -9}, {10, 20, -9}, {-10, 20, -9}));
    const auto echoes = echoes_of(meshes, {{0, 0, -3}, {}}, {}, 3);
    ASSERT_EQ(echoes.size(), 1U);
    const double range = norm({10, 4, 6});
    EXPECT_NEAR(echoes[0].range, range, 1e-4);
    EXPECT_NEAR(test::db(echoes[0].power), 200 - 20 * std::log10(2 * range) + 60 * std::log10(reflection),
                0.1);
}

TEST(Corners, WallAndSurfaceMakeOneToo) {
    const std::vector<Mesh> quay{mirror({10, 20, -20}, {10, -20, -20}, {10, -20, 1}, {10, 20, 1})};
    const auto echoes = echoes_of(quay, {{0, 0, -3}, {}}, WaterSurface{}, 2);
    ASSERT_EQ(echoes.size(), 1U);
    EXPECT_NEAR(echoes[0].range, std::hypot(10, 3), 1e-4);
    EXPECT_NEAR(test::db(echoes[0].power),
                200 - 20 * std::log10(2 * std::hypot(10, 3)) + 20 * std::log10(reflection), 0.3);
}

// Urick's table 9.1: a corner of the effective area A has 20 log10(A / lambda). 2 x 2 cm plates, seen at 45
// degrees.
TEST(Corners, SmallCornerHasTheStrengthOfItsArea) {
    const double w = 0.02, s = w / std::numbers::sqrt2, range = 3;
    const double k = 2 * std::numbers::pi * 750e3 / test::sound;
    ASSERT_LT(w, 2 * std::sqrt(range / k));
    const std::vector<Mesh> plates{
        mirror({range, 0, -w / 2}, {range, 0, w / 2}, {range - s, s, w / 2}, {range - s, s, -w / 2}),
        mirror({range, 0, w / 2}, {range, 0, -w / 2}, {range - s, -s, -w / 2}, {range - s, -s, w / 2})};
    Shot shot = test::fan(1, 1, 1, 500, 50);
    std::vector<TargetEcho> echoes;
    for (shot.ping = 0; shot.ping < 20 && echoes.empty(); ++shot.ping)
        echoes = echoes_of(plates, {}, {}, 2, shot);
    ASSERT_EQ(echoes.size(), 1U);
    EXPECT_NEAR(echoes[0].range, range, 1e-5);
    const double area = std::numbers::sqrt2 * w * w;
    EXPECT_NEAR(test::db(echoes[0].power),
                200 + 40 * std::log10(reflection) - 40 * std::log10(range) + 20 * std::log10(area / 2e-3),
                1.0);
}

TEST(Corners, ObtuseOrHiddenCornersAreSilent) {
    // 100 degrees instead of 90.
    auto obtuse = two_walls();
    for (Vec3& p : obtuse[0].positions)
        if (p.y > 0) p.x += 24 * std::tan(deg_to_rad(10));
    EXPECT_TRUE(echoes_of(obtuse, {{0, 0, -3}, {}}, {}, 2).empty());
    // A post hides the edge.
    auto hidden = two_walls();
    hidden.push_back(
        test::dull(test::quad("post", {5, -1.5, -20}, {5, -2.5, -20}, {5, -2.5, 20}, {5, -1.5, 20})));
    EXPECT_TRUE(echoes_of(hidden, {{0, 0, -3}, {}}, {}, 2).empty());
    // Rough walls scatter instead.
    auto rough = two_walls();
    for (Mesh& mesh : rough) mesh.material.roughness = 0.01;
    EXPECT_TRUE(echoes_of(rough, {{0, 0, -3}, {}}, {}, 2).empty());
}

}  // namespace
}  // namespace echoloop
