// The sonar's images in several mirrors: ranges, levels, and what is left out.
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "render/paths/chains.h"
#include "tests/render/paths/path_rooms.h"

namespace echoloop {
namespace {

constexpr double reflection = 0.686, nepers = 0.146 / 8.685889638;

Mesh turned(Mesh mesh, double yaw) {
    for (Vec3& p : mesh.positions) p = rotate(axis_angle({0, 0, 1}, yaw), p);
    return mesh;
}

/// Walls 2 m ahead and 4 m astern.
std::vector<Mesh> channel(double roughness = 0) {
    return {test::smooth(test::wall_at(2, 20, -20, 20), reflection, roughness),
            test::smooth(turned(test::wall_at(4, 20, -20, 20), std::numbers::pi), reflection, roughness)};
}

Shot head() {
    Shot shot = test::fan(3, 35, 1, 700, 20);
    shot.frequency = 700e3;
    return shot;
}

std::vector<TargetEcho> images(const std::vector<Mesh>& meshes, Effects effects, const Pose& pose = {},
                               const Shot& shot = head()) {
    auto found = test::trace(test::scene_of(meshes), {}, effects, shot, pose, nepers, 20).targets;
    std::ranges::sort(found, {}, &TargetEcho::range);
    return found;
}

const Effects quiet = test::without({Effect::noise});

TEST(Images, AHeadHearsTheOddOrdersOfAChannel) {
    const auto found = images(channel(), quiet);
    std::vector<TargetEcho> loud;
    for (const TargetEcho& echo : found)
        if (test::db(echo.power) > 145) loud.push_back(echo);
    ASSERT_EQ(loud.size(), 3U);
    const struct { double range, level; } expected[] = {{2, -15.90}, {8, -36.24}, {14, -49.40}};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(loud[i].range, expected[i].range, 1e-6);
        EXPECT_NEAR(test::db(loud[i].power) - 200, expected[i].level, 0.1);
        EXPECT_EQ(loud[i].bounces, 2 * static_cast<int>(i) + 1);
    }
}

TEST(Images, EvenOrdersGoOutByOneSideAndComeBackByTheOther) {
    Shot all_round = head();
    all_round.beam_width = 2 * std::numbers::pi;
    const auto found = images(channel(), test::without({Effect::noise, Effect::beam_pattern}), {}, all_round);
    for (const auto& [range, level] : {std::pair(6.0, -29.88), std::pair(12.0, -44.20)}) {
        int count = 0;
        for (const TargetEcho& echo : found)
            if (std::abs(echo.range - range) < 1e-6) {
                ++count;
                EXPECT_NEAR(test::db(echo.power) - 200, level, 0.1);
            }
        EXPECT_EQ(count, 2) << "at " << range << " m";
    }
}

// The path does not depend on rays that are placed anew for every ping.
TEST(Images, TheyStayFromPingToPing) {
    Shot shot = head();
    const auto first = images(channel(), quiet, {}, shot);
    for (shot.ping = 1; shot.ping < 20; ++shot.ping) {
        const auto later = images(channel(), quiet, {}, shot);
        ASSERT_EQ(later.size(), first.size());
        for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(later[i].power, first[i].power);
    }
}

TEST(Images, WhatStandsInTheirWayHidesThem) {
    auto meshes = channel();
    meshes.push_back(test::dull(test::box("crate", {-2, 0, 0}, {0.5, 0.5, 0.5})));
    const auto found = images(meshes, quiet);
    EXPECT_EQ(std::ranges::count_if(found, [](const TargetEcho& e) { return e.bounces > 1; }), 0);
    EXPECT_EQ(std::ranges::count_if(found, [](const TargetEcho& e) { return std::abs(e.range - 2) < 1e-6; }),
              1);
}

TEST(Images, RoughWallsKeepTheirEnergy) {
    auto walls = channel(0.01);
    for (Mesh& wall : walls) wall.material.lobe = true;
    const auto scene = test::scene_of(walls);
    double third = 0;
    constexpr int pings = 64;
    Shot shot = head();
    for (shot.ping = 0; shot.ping < pings; ++shot.ping) {
        const auto echoes = test::trace(scene, {}, quiet, shot, {}, nepers, 20);
        EXPECT_EQ(std::ranges::count_if(echoes.targets, [](const TargetEcho& e) { return e.bounces > 1; }),
                  0);
        for (const PathEcho& echo : echoes.diffuse)
            if (echo.near_range > 8 - 1e-3F && echo.near_range < 11)
                third += static_cast<double>(echo.power) / pings;
    }
    const double slope = 0.15;  // sand's, as the material says nothing else
    const ChainMirror chain[] = {{2.0 / 16, slope}, {8.0 / 16, slope}, {14.0 / 16, slope}};
    const auto spread = [](double deg) { return deg_to_rad(deg) / (2 * std::sqrt(std::numbers::ln2)); };
    const double expected = -36.24 + test::db(chain_share(chain, spread(3)).power) +
                            test::db(chain_share(chain, spread(35)).power);
    EXPECT_NEAR(test::db(third) - 200, expected, 0.7);  // of Gaussian beams; this one has side lobes
}

TEST(Images, OneRoughMirrorIsTheLobeOfAPlane) {
    const ChainMirror mirror{0.5, 0.1};
    const double spread = deg_to_rad(10) / 2.355;
    const double share = chain_share({&mirror, 1}, spread).power;
    EXPECT_NEAR(test::db(share * share), -6.67, 0.01);
    EXPECT_EQ(chain_share({&mirror, 1}, std::numeric_limits<double>::infinity()).power, 1);
    EXPECT_NEAR(chain_share({&mirror, 1}, std::numeric_limits<double>::infinity()).variance, 0.01, 1e-9);
}

/// uPa^2 of what an echosounder 2 m below a rough surface hears of the bottom, 6 m below itself, once more:
/// the mean of 32 pings.
double second_bottom(const Mesh& floor) {
    const Pose down{{0, 0, -2}, axis_angle({0, 1, 0}, std::numbers::pi / 2)};
    constexpr int pings = 32;
    Shot shot = test::fan(8, 8, 1, 700, 20);
    PathTracer tracer(test::scene_of({floor}), WaterSurface{0, 0.01}, quiet);
    double sum = 0;
    for (shot.ping = 0; shot.ping < pings; ++shot.ping) {
        PathEchoes echoes;
        tracer.trace(shot, down, test::sound, 0, 20, echoes);
        for (const PathEcho& echo : echoes.diffuse)
            if (std::abs(echo.near_range - 14.5) < 0.6F) sum += static_cast<double>(echo.power);
    }
    return sum / pings;
}

// An echosounder sees the bottom once more by way of a rough surface; also where the bottom is no plane.
TEST(Images, SecondBottomFlatAndRippled) {
    for (const bool flat : {true, false}) {
        Mesh floor = test::floor_at(-8, 20, 80);
        if (!flat)
            for (Vec3& p : floor.positions) p.z += 0.02 * std::sin(2 * p.x) * std::cos(2 * p.y);
        const double second = second_bottom(floor);
        // V^2 / 28 m of two rough sandy mirrors; the chain takes 20 dB more. Sand sends back 20.4 dB less
        // than its facets would, mu / (V^2 / (8 pi s^2)); ripples make the lobe lower, and so this less.
        const double smooth = 200 - 20 * std::log10(28) + 40 * std::log10(0.353);
        EXPECT_LT(test::db(second), smooth - 25) << flat;
        EXPECT_GT(test::db(second), smooth - 41) << flat;
        if (!flat) continue;
        Mesh faceted = test::floor_at(-8, 20, 80);
        faceted.material.lobe = true;
        EXPECT_NEAR(test::db(second_bottom(faceted) / second), 20.45, 0.1);
    }
}

// A fan hears it in every beam around the nadir, the later the farther out.
TEST(Images, AFanHearsTheSecondBottomWithoutGaps) {
    const Pose down{{0, 0, -2}, axis_angle({0, 1, 0}, std::numbers::pi / 2)};
    const Shot shot = test::fan(120, 1, 256, 700, 20);
    const auto echoes = test::trace(test::scene_of({test::floor_at(-8, 200)}), WaterSurface{0, 0.01}, quiet,
                                    shot, down, 0, 20);
    std::set<double> bearings;
    for (const PathEcho& echo : echoes.diffuse) {
        const double bearing = echo.bearing, range = 14 * (1 + bearing * bearing / 2);
        if (std::abs(bearing) < 0.3 && std::abs(echo.near_range - range) < 1e-3) bearings.insert(bearing);
    }
    double last = -0.3;
    for (const double bearing : bearings) {
        EXPECT_LT(bearing - last, 1.01 * shot.beam_width);
        last = bearing;
    }
    EXPECT_GT(last, 0.3 - shot.beam_width);
}

}  // namespace
}  // namespace echoloop
