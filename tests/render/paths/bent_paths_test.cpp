// Targets and mirrors in layered water: V35 of the reference values, and times by integrals of slowness.
#include <gtest/gtest.h>

#include "render/ray_table.h"
#include "render/refraction.h"
#include "tests/render/paths/path_rooms.h"

namespace echoloop {
namespace {

using Profile = std::vector<SoundSpeedPoint>;

const Profile thermocline{{0, 1515}, {10, 1515}, {20, 1485}};
const double head_speed = 1515;
const WaterSurface still{0, 0};

PathEchoes echoes_of(const std::shared_ptr<const Scene>& scene, const RayTable& rays, double tilt_deg,
                     Effects effects, const WaterSurface& surface = still) {
    Shot shot = test::wide_beam(20, 20);
    shot.tilt = deg_to_rad(tilt_deg);
    PathTracer tracer(scene, surface, effects);
    PathEchoes echoes;
    tracer.trace(shot, Pose{{0, 0, -rays.depth()}, {}}, rays.speed(), 0, rays.range(), echoes, {}, {}, &rays);
    return echoes;
}

std::shared_ptr<const Scene> target_at(Vec3 place) {
    const PointTarget target{"target", place, 0};
    const Mesh far_away = test::dull(test::floor_at(-900, 1));
    return Scene::from_meshes(std::span(&far_away, 1), std::span(&target, 1));
}

TEST(BentPaths, TargetsAreSeenWhereTheirRayLeavesAndWhenItComesBack) {
    const RayTable rays(thermocline, 2, 300, true);
    struct Row {
        double launch_deg, x, ms;
    };
    for (const Row& row :
         {Row{30, 55.30, 75.574}, {45, 94.73, 91.540}, {60, 159.00, 125.438}, {65, 192.29, 144.944}}) {
        const auto echoes = echoes_of(target_at({row.x, 0, -100}), rays, row.launch_deg - 90,
                                      test::without({Effect::multipath}));
        ASSERT_EQ(echoes.targets.size(), 1U) << row.launch_deg;
        EXPECT_NEAR(echoes.targets[0].range, row.ms / 1e3 * head_speed, 0.03);
        EXPECT_NEAR(rad_to_deg(echoes.targets[0].elevation), 0, 0.03)
            << "the fan was tilted to where it leaves";
    }
}

TEST(BentPaths, TargetsInAShadowAreSilent) {
    const RayTable rays(Profile{{0, 1500}, {50, 1350}}, 5, 200, true);
    const auto number = [&](double x) {
        return echoes_of(target_at({x, 0, -5}), rays, 0, test::without({Effect::multipath})).targets.size();
    };
    EXPECT_EQ(number(138), 1U);
    EXPECT_EQ(number(144), 0U);
}

// A wall in the way of the straight line, below which the bent ray passes, and one in the way of the ray.
TEST(BentPaths, WhatHidesATargetLiesOnItsRay) {
    const RayTable rays(Profile{{0, 1500}, {400, 1300}}, 50, 300,
                        true);  // a level ray drops by 11.1 m at 258 m
    const PointTarget target{"target", {250, 0, -50}, 0};
    const auto seen = [&](double low, double high) {
        const Mesh wall = test::dull(test::wall_at(125, 5, low, high));
        const auto scene = Scene::from_meshes(std::span(&wall, 1), std::span(&target, 1));
        return echoes_of(scene, rays, 0, test::without({Effect::multipath})).targets.size();
    };
    // The ray rises to 2.6 m above the line.
    EXPECT_EQ(seen(-51.0, -49.0), 1U);
    EXPECT_EQ(seen(-48.4, -46.4), 0U);
}

TEST(BentPaths, BottomsGlintAndTheirRoundTripsComeByTheTimeOfPlumbRays) {
    const RayTable rays(thermocline, 2, 320, true);
    const double down = 65.820e-3 * head_speed;  // V35
    const auto scene = test::scene_of({test::smooth(test::floor_at(-100, 600), 0.5)});
    const auto echoes = echoes_of(scene, rays, -90, test::without({Effect::noise}));
    const auto found = [&](double range) {
        return std::ranges::any_of(echoes.targets,
                                   [&](const TargetEcho& e) { return std::abs(e.range - range) < 0.02; });
    };
    EXPECT_TRUE(found(down));
    EXPECT_TRUE(found(2 * down + 2)) << "bottom, surface, bottom";
}

TEST(BentPaths, AWaysByTheSurfaceTakesTheTimeOfItsLegs) {
    const Profile profile{{0, 1500}, {200, 1400}};
    const RayTable rays(profile, 50, 200, true);
    const auto echoes = echoes_of(target_at({100, 0, -30}), rays, 20, test::without({Effect::noise}));
    // Up to the surface at x 62.5, and down: mean slowness is ln(c1 / c2) / (c1 - c2).
    const double c0 = 1475, c1 = 1500, c2 = 1485;
    const auto leg = [&](double length, double c) { return length * c0 * std::log(c1 / c) / (c1 - c); };
    const double by_surface = leg(std::hypot(62.5, 50), c0) + leg(std::hypot(37.5, 30), c2);
    EXPECT_TRUE(std::ranges::any_of(echoes.targets, [&](const TargetEcho& e) {
        return e.bounces == 2 && std::abs(e.range - by_surface) < 0.03;
    }));
}

}  // namespace
}  // namespace echoloop
