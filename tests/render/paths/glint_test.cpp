// Faces that look at the sonar: what counts as one, and what comes back from it.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/render/paths/path_rooms.h"

namespace echoloop {
namespace {

const Effects boxes = test::without({Effect::beam_pattern, Effect::noise});

Mesh polished_wall(double x, double half_width = 20, double z0 = -20, double z1 = 20) {
    return test::smooth(test::wall_at(x, half_width, z0, z1), 0.8);
}

std::vector<TargetEcho> glints(const std::vector<Mesh>& meshes, const Pose& pose = {},
                               const Shot& shot = test::wide_beam(60, 60)) {
    auto all = test::trace(test::scene_of(meshes), {}, boxes, shot, pose).targets;
    std::erase_if(all, [](const TargetEcho& echo) { return echo.bounces != 1; });
    return all;
}

double mirror_db(double range, double reflection) {
    return 200 - 20 * std::log10(2 * range) + 20 * std::log10(reflection);
}

/// Level of all echoes together, with their phases.
double sum_db(const std::vector<TargetEcho>& echoes) {
    double re = 0, im = 0;
    for (const TargetEcho& echo : echoes) {
        re += std::sqrt(echo.power) * std::cos(echo.phase);
        im += std::sqrt(echo.power) * std::sin(echo.phase);
    }
    return test::db(re * re + im * im);
}

TEST(Glints, AWallMirrorsTheSonar) {
    const auto found = glints({polished_wall(7)}, {{0, 2, 1}, {}});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].range, 7, 1e-6);
    EXPECT_NEAR(found[0].bearing, 0, 1e-9);
    EXPECT_NEAR(test::db(found[0].power), mirror_db(7, 0.8), 0.1);
}

TEST(Glints, AWallIsHeardFromTheFootOfThePerpendicular) {
    const auto found = glints({polished_wall(7)}, {{0, 0, 0}, axis_angle({0, 0, 1}, deg_to_rad(20))});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(rad_to_deg(found[0].bearing), 20, 1e-6);
}

TEST(Glints, ManySmallTrianglesAreOneMirror) {
    Mesh fine = test::smooth(test::floor_at(-5, 10, 64), 0.8);
    const Pose down{{0.3, 0.2, 0}, axis_angle({0, 1, 0}, std::numbers::pi / 2)};
    const auto scene = test::scene_of({fine});
    ASSERT_EQ(scene->faces().size(), 1U);
    EXPECT_EQ(scene->faces()[0].edges, 4U);
    EXPECT_NEAR(scene->faces()[0].area, 400, 1e-3);
    const auto found = glints({fine}, down);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(test::db(found[0].power), mirror_db(5, 0.8), 0.1);
}

// A turned floor far from the origin, whose corners are rounded to floats.
TEST(Glints, RoundedPositionsMakeNoPlaneTwo) {
    Mesh floor = test::floor_at(0, 50, 60);
    const Pose turned{{800, -300, -20}, from_rpy(0.1, 0.2, 0.3)};
    for (Vec3& p : floor.positions) {
        p = turned * p;
        p = {double{static_cast<float>(p.x)}, double{static_cast<float>(p.y)},
             double{static_cast<float>(p.z)}};
    }
    EXPECT_EQ(test::scene_of({floor})->faces().size(), 1U);
}

TEST(Glints, PanelsSideBySideAddUpToTheWall) {
    std::vector<Mesh> panels;
    for (int i = 0; i < 6; ++i) {
        Mesh panel = polished_wall(7, 0.05, -10, 10);
        for (Vec3& p : panel.positions) p.y += 0.1 * i - 0.23;
        panels.push_back(panel);
    }
    Mesh whole = polished_wall(7, 0.3, -10, 10);
    for (Vec3& p : whole.positions) p.y += 0.02;
    EXPECT_GT(glints(panels).size(), 2U);
    EXPECT_NEAR(sum_db(glints(panels)), sum_db(glints({whole})), 0.1);
}

TEST(Glints, WhatStandsBetweenHidesThem) {
    EXPECT_TRUE(glints({polished_wall(7), test::dull(test::box("crate", {3, 0, 0}, {1, 1, 1}))}).empty());
}

TEST(Glints, OnlyTheSideThatIsThere) {
    const Pose behind{{9, 0, 0}, axis_angle({0, 0, 1}, std::numbers::pi)};
    Mesh wall = polished_wall(7);
    EXPECT_TRUE(glints({wall}, behind).empty());
    wall.material.double_sided = true;
    EXPECT_EQ(glints({wall}, behind).size(), 1U);
}

TEST(Glints, AHoleIsNoMirror) {
    const auto ring = [](double inner) {
        std::vector<Mesh> parts;
        const double o = 3;
        for (const auto& [y0, y1, z0, z1] :
             {std::array{-o, o, inner, o}, std::array{-o, o, -o, -inner},
              std::array{-o, -inner, -inner, inner}, std::array{inner, o, -inner, inner}})
            parts.push_back(
                test::smooth(test::quad("plate", {7, y1, z0}, {7, y0, z0}, {7, y0, z1}, {7, y1, z1}), 0.8));
        return parts;
    };
    EXPECT_LT(sum_db(glints(ring(1.5))), mirror_db(7, 0.8) - 20);
}

TEST(Glints, ABoxTurnedAwayIsDark) {
    const auto square = test::smooth(test::box("box", {8, 0, 0}, {2, 2, 2}), 0.8);
    const auto turned = test::smooth(test::box("box", {8, 0, 0}, {2, 2, 2}, deg_to_rad(30)), 0.8);
    EXPECT_NEAR(sum_db(glints({square})), mirror_db(7, 0.8), 0.2);
    EXPECT_TRUE(glints({turned}).empty());
}

TEST(Glints, RoughFacesLoseThem) {
    const double k = 2 * std::numbers::pi * 750e3 / test::sound, height = 1e-4;
    Mesh wall = polished_wall(7);
    wall.material.roughness = height;
    EXPECT_NEAR(sum_db(glints({wall})), mirror_db(7, 0.8) - 4.3429 * std::pow(2 * k * height, 2), 0.1);
}

TEST(Glints, MoversTakeThemAlong) {
    Mesh wall = polished_wall(7);
    wall.object = "gate";
    const std::vector<std::string> movable{"gate"};
    const auto scene = Scene::from_meshes(std::vector<Mesh>{wall}, {}, movable);
    PathTracer tracer(scene, std::nullopt, boxes);
    const Pose moved{{1.5, 0, 0}, axis_angle({0, 0, 1}, 0.1)};
    PathEchoes echoes;
    tracer.trace(test::wide_beam(), {}, test::sound, 0, 50, echoes, std::span(&moved, 1));
    ASSERT_EQ(echoes.targets.size(), 1U);
    // The plane through (8.5, 0) and its like, turned by 0.1 rad about the origin and moved.
    EXPECT_NEAR(echoes.targets[0].range, 7 + 1.5 * std::cos(0.1), 1e-6);
    EXPECT_NEAR(echoes.targets[0].bearing, -0.1, 1e-6);
}

TEST(Glints, NoneWithoutMultipath) {
    EXPECT_TRUE(test::trace(test::scene_of({polished_wall(7)}), {},
                            test::without({Effect::beam_pattern, Effect::multipath}), test::wide_beam(), {})
                    .targets.empty());
}

TEST(Surfaces, ASphereIsCurvedAndABoxIsNot) {
    const auto scene =
        test::scene_of({test::sphere({0, 0, 0}, 1, 24), test::box("box", {5, 0, 0}, {1, 1, 1})});
    EXPECT_EQ(scene->faces().size(), 6U);
    ASSERT_EQ(scene->materials().size(), 2U);
    EXPECT_NEAR(scene->materials()[0].mesh_slope, deg_to_rad(7.5) / 2, 0.02);
    EXPECT_EQ(scene->materials()[1].mesh_slope, 0);
}

/// A wall with a rounded edge on all four sides, in steps of 12.9 deg.
TEST(Surfaces, BevelsLeaveAWallFlat) {
    Mesh wall;
    wall.object = "wall";
    const int steps = 7;
    const double radius = 0.02;
    std::vector<std::array<std::uint32_t, 4>> rings;
    for (int i = 0; i <= steps; ++i) {
        const double angle = std::numbers::pi / 2 * i / steps;
        const double reach = 2 + radius * std::sin(angle), depth = 7 + radius * (1 - std::cos(angle));
        std::array<std::uint32_t, 4> ring{};
        for (std::size_t corner = 0; corner < 4; ++corner) {
            ring[corner] = static_cast<std::uint32_t>(wall.positions.size());
            const double y = corner == 0 || corner == 3 ? reach : -reach, z = corner < 2 ? -reach : reach;
            wall.positions.push_back({depth, y, z});
        }
        rings.push_back(ring);
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        for (const std::uint32_t corner : {a, b, c, a, c, d}) wall.indices.push_back(corner);
    };
    add(rings[0][0], rings[0][1], rings[0][2], rings[0][3]);
    for (int i = 0; i < steps; ++i)
        for (std::size_t c = 0; c < 4; ++c) {
            const auto& in = rings[static_cast<std::size_t>(i)];
            const auto& out = rings[static_cast<std::size_t>(i) + 1];
            add(in[(c + 1) % 4], in[c], out[c], out[(c + 1) % 4]);
        }
    EXPECT_NEAR(sum_db(glints({test::smooth(wall, 0.8)})), mirror_db(7, 0.8), 0.2);
}

TEST(Surfaces, OnlyTheLargestFacesCount) {
    std::vector<Mesh> crowd;
    for (int i = 0; i < 800; ++i)
        crowd.push_back(test::box("box", {3.0 * (i % 40), 3.0 * (i / 40), 0}, {0.2, 0.2, 0.2}));
    crowd.push_back(polished_wall(7));
    const auto scene = test::scene_of(crowd);
    EXPECT_EQ(scene->faces().size(), 4096U);
    EXPECT_EQ(std::ranges::count_if(scene->faces(), [](const SceneFace& f) { return f.area > 1000; }), 1);
}

TEST(Surfaces, ReflectionGivesWayToScattering) {
    Mesh white = test::wall_at(7, 1, -1, 1, -4.9715);
    white.material.reflection = 0.9;
    EXPECT_NEAR(test::scene_of({white})->materials()[0].reflection, 0, 0.01);
}

}  // namespace
}  // namespace echoloop
