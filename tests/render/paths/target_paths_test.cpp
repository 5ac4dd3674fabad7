// Targets of declared strength against the sonar equation and image sources (V1, V13 of the reference
// values).
#include <gtest/gtest.h>

#include "render/acoustics/pattern.h"
#include "tests/render/paths/path_rooms.h"

namespace echoloop {
namespace {

constexpr double ts = -20;
const Vec3 target_place{10, 0, -4};
const Pose sonar{{0, 0, -3}, {}};

std::shared_ptr<const Scene> pool(std::vector<Mesh> meshes = {}) {
    meshes.push_back(
        test::dull(test::floor_at(-500, 10)));  // a scene has a triangle; this one is out of reach
    return Scene::from_meshes(meshes, std::vector{PointTarget{"ball", target_place, ts}});
}

const Effects boxes = test::without({Effect::beam_pattern});

TEST(TargetPaths, DirectEchoFollowsTheSonarEquation) {
    const Shot shot = test::wide_beam();
    const double a = 0.02;
    const auto echoes = test::trace(pool(), {}, boxes, shot, sonar, a);
    ASSERT_EQ(echoes.targets.size(), 1U);
    const double range = std::sqrt(101);
    EXPECT_NEAR(echoes.targets[0].range, range, 1e-6);
    EXPECT_EQ(echoes.targets[0].bounces, 0);
    EXPECT_NEAR(test::db(echoes.targets[0].power),
                shot.source_level - 40 * std::log10(range) - 2 * neper_to_db(a) * range + ts, 1e-6);
    EXPECT_TRUE(echoes.diffuse.empty());
}

TEST(TargetPaths, SpreadingCanBeSwitchedOff) {
    auto effects = boxes;
    const auto echoes =
        test::trace(pool(), {}, effects.set(Effect::spreading, false), test::wide_beam(), sonar);
    EXPECT_NEAR(test::db(echoes.targets.at(0).power), 200 + ts, 1e-6);
}

// V13: sonar 3 m deep, target 4 m deep, 10 m away: 10.050, 11.128 and 12.207 m.
TEST(TargetPaths, SurfaceGivesTwoMoreEchoes) {
    const auto echoes = test::trace(pool(), WaterSurface{}, boxes, test::wide_beam(), sonar);
    ASSERT_EQ(echoes.targets.size(), 3U);
    const double direct = std::sqrt(101), image = std::sqrt(149);
    const double range[3] = {10.050, 11.128, 12.207};
    // One bounce: there or back, two paths in phase, so 6 dB; the reflection turns the phase by pi.
    const double level[3] = {200 + ts - 40 * std::log10(direct),
                             206.0206 + ts - 20 * std::log10(direct * image),
                             200 + ts - 40 * std::log10(image)};
    const double wavenumber = 2 * std::numbers::pi * 750e3 / test::sound;
    for (std::size_t i = 0; i < 3; ++i) {
        const TargetEcho& echo = echoes.targets[i];
        EXPECT_NEAR(echo.range, range[i], 5e-4);
        EXPECT_NEAR(test::db(echo.power), level[i], 1e-3) << i;
        EXPECT_EQ(echo.bounces, static_cast<int>(i));
        EXPECT_NEAR(std::cos(echo.phase), (i == 1 ? -1 : 1) * std::cos(2 * wavenumber * echo.range), 1e-6)
            << i;
    }
}

TEST(TargetPaths, RoughSurfaceTakesItsLossTwice) {
    const double roughness = 2e-4, k = 2 * std::numbers::pi * 750e3 / test::sound;
    const auto smooth = test::trace(pool(), WaterSurface{}, boxes, test::wide_beam(), sonar);
    const auto rough = test::trace(pool(), WaterSurface{0, roughness}, boxes, test::wide_beam(), sonar);
    ASSERT_EQ(rough.targets.size(), 3U);
    const double sine = 7 / std::sqrt(149),
                 loss_db = 20 * std::log10(std::exp(-2 * std::pow(k * roughness * sine, 2)));
    EXPECT_NEAR(test::db(rough.targets[0].power / smooth.targets[0].power), 0, 1e-9);
    EXPECT_NEAR(test::db(rough.targets[1].power / smooth.targets[1].power), loss_db, 1e-6);
    EXPECT_NEAR(test::db(rough.targets[2].power / smooth.targets[2].power), 2 * loss_db, 1e-6);
    EXPECT_LT(loss_db, -1);
}

TEST(TargetPaths, MultipathOffLeavesTheDirectEchoAsItWas) {
    auto effects = boxes;
    const auto on = test::trace(pool(), WaterSurface{}, boxes, test::wide_beam(), sonar);
    const auto off =
        test::trace(pool(), WaterSurface{}, effects.set(Effect::multipath, false), test::wide_beam(), sonar);
    ASSERT_EQ(off.targets.size(), 1U);
    EXPECT_EQ(off.targets[0].power, on.targets[0].power);
    EXPECT_EQ(off.targets[0].range, on.targets[0].range);
    EXPECT_TRUE(off.diffuse.empty());
}

// Both patterns along both ways: elevations -5.71 and +34.99 degrees. Directions are weighed by a table of
// the pattern, which is within 0.01 dB of it one way.
TEST(TargetPaths, PatternsWeighTheFirstAndTheLastLeg) {
    const Shot shot = test::wide_beam(60, 50);
    const auto echoes = test::trace(pool(), WaterSurface{}, Effects{}, shot, sonar);
    ASSERT_EQ(echoes.targets.size(), 3U);
    const TwoWayPattern vertical(shot.vertical, shot.fan_height);
    const double down = vertical.amplitude(std::atan2(-1, 10)), up = vertical.amplitude(std::atan2(7, 10));
    const double direct = std::sqrt(101), image = std::sqrt(149), source = 1e20 * 0.01, table = 0.02;
    EXPECT_NEAR(test::db(echoes.targets[0].power), test::db(source * std::pow(down, 4) / std::pow(direct, 4)),
                table);
    EXPECT_NEAR(test::db(echoes.targets[1].power),
                test::db(source * 4 * std::pow(down * up, 2) / std::pow(direct * image, 2)), table);
    EXPECT_NEAR(test::db(echoes.targets[2].power), test::db(source * std::pow(up, 4) / std::pow(image, 4)),
                table);
}

TEST(TargetPaths, BearingIsClockwiseFromThePannedAxis) {
    Shot shot = test::fan(120, 40, 64, 500, 50);
    shot.pan = deg_to_rad(20);
    const Pose yawed{{0, 0, -4},
                     axis_angle({0, 0, 1}, deg_to_rad(30))};  // target 30 deg to starboard, pan takes 20
    const auto echoes = test::trace(pool(), {}, Effects{}, shot, yawed);
    ASSERT_EQ(echoes.targets.size(), 1U);
    EXPECT_NEAR(rad_to_deg(echoes.targets[0].bearing), 10, 1e-6);
}

// The horizontal pattern of one beam is in the power; that of a fan's receiver is left to who sums the beams.
TEST(TargetPaths, HorizontalPatternCountsForASingleBeamOnly) {
    Shot one = test::fan(3, 40, 1, 500, 50);
    one.pan = deg_to_rad(1.5);  // the target is on the edge of the beam
    const Pose level{{0, 0, -4}, {}};
    const auto echoes = test::trace(pool(), {}, Effects{}, one, level);
    EXPECT_NEAR(test::db(echoes.targets.at(0).power), 200 + ts - 40 - 3.01, 0.01);
    Shot many = test::fan(120, 40, 40, 500, 50);
    many.horizontal.ways = 1;
    EXPECT_NEAR(test::db(test::trace(pool(), {}, Effects{}, many, level).targets.at(0).power), 200 + ts - 40,
                1e-6);
}

// Rolled by 45 degrees, the ways by the surface and straight arrive from different bearings.
TEST(TargetPaths, BeamsOfAFanHearReciprocalWaysApart) {
    const Shot shot = test::fan(120, 100, 64, 500, 50);
    const Pose rolled{sonar.position, axis_angle({1, 0, 0}, deg_to_rad(45))};
    const auto echoes = test::trace(pool(), WaterSurface{}, boxes, shot, rolled).targets;
    ASSERT_EQ(echoes.size(), 4U);
    EXPECT_EQ(echoes[1].range, echoes[2].range);
    EXPECT_EQ(echoes[1].phase, echoes[2].phase);
    EXPECT_DOUBLE_EQ(echoes[1].power, echoes[2].power);
    EXPECT_NEAR(echoes[1].bearing, echoes[0].bearing, 1e-9);
    EXPECT_NEAR(echoes[2].bearing, echoes[3].bearing, 1e-9);
    EXPECT_GT(std::abs(echoes[1].bearing - echoes[2].bearing), deg_to_rad(10));
    EXPECT_NEAR(test::db(echoes[1].power), 200 + ts - 20 * std::log10(std::sqrt(101 * 149)), 1e-6);
}

TEST(TargetPaths, NothingIsHeardBehindAWall) {
    const auto hidden = pool({test::dull(test::wall_at(5, 5, -6, -0.5))});
    // The way by the surface passes over the wall.
    const auto echoes = test::trace(hidden, WaterSurface{}, boxes, test::wide_beam(), sonar);
    ASSERT_EQ(echoes.targets.size(), 0U);
    const auto low = pool({test::dull(test::wall_at(5, 5, -6, -2))});
    const auto over = test::trace(low, WaterSurface{}, boxes, test::wide_beam(), sonar);
    ASSERT_EQ(over.targets.size(), 1U);
    EXPECT_NEAR(over.targets[0].range, std::sqrt(149), 1e-6);
    // A one-sided wall that faces away is not there.
    const auto away = pool({test::dull(test::quad("wall", {5, -5, -6}, {5, 5, -6}, {5, 5, 0}, {5, -5, 0}))});
    EXPECT_EQ(test::trace(away, {}, boxes, test::wide_beam(), sonar).targets.size(), 1U);
}

TEST(TargetPaths, SmoothBottomMirrorsWithItsReflection) {
    const auto scene = pool({test::smooth(test::floor_at(-9, 40, 8), 0.5)});
    const auto echoes = test::trace(scene, {}, boxes, test::wide_beam(), sonar);
    ASSERT_EQ(echoes.targets.size(), 3U);
    const double image = std::sqrt(100 + 121.0);
    EXPECT_NEAR(echoes.targets[2].range, image, 1e-4);
    EXPECT_NEAR(test::db(echoes.targets[2].power), 200 + ts - 40 * std::log10(image) + 40 * std::log10(0.5),
                1e-3);
}

TEST(TargetPaths, SlopingBottomIsFoundToo) {
    // A slope that rises by 20 degrees away from the sonar.
    const double rise = std::tan(deg_to_rad(20));
    const auto slope = test::smooth(test::quad("slope", {-20, -20, -9 - 20 * rise}, {20, -20, -9 + 20 * rise},
                                               {20, 20, -9 + 20 * rise}, {-20, 20, -9 - 20 * rise}),
                                    0.5);
    const auto echoes = test::trace(pool({slope}), {}, boxes, test::wide_beam(), sonar);
    ASSERT_EQ(echoes.targets.size(), 3U);
    const Vec3 normal = 1 / std::hypot(1, rise) * Vec3{-rise, 0, 1};
    const Vec3 image = target_place - 2 * dot(target_place - Vec3{0, 0, -9}, normal) * normal;
    EXPECT_NEAR(echoes.targets[2].range, norm(image - sonar.position), 1e-3);
}

TEST(TargetPaths, SonarInTheAirHearsNoSurface) {
    const Pose above{{0, 0, 2}, {}};
    EXPECT_EQ(test::trace(pool(), WaterSurface{}, boxes, test::wide_beam(), above).targets.size(), 1U);
}

}  // namespace
}  // namespace echoloop
