// Where echoes stand: range, bearing, shadow, layover, first return and the ends of the window (V3, V11,
// V12).
#include <gtest/gtest.h>

#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using test::scene_of;

/// A small plate at `bearing` (clockwise) and `range` that faces the origin.
Mesh plate(double bearing, double range, double side) {
    const Quat turn = axis_angle({0, 0, 1}, -bearing);
    const auto corner = [&](double y, double z) { return rotate(turn, {range, y * side / 2, z * side / 2}); };
    return test::quad("plate", corner(1, -1), corner(-1, -1), corner(-1, 1), corner(1, 1), -5);
}

std::size_t strongest_beam(const Echogram& e) {
    std::size_t best = 0;
    for (std::size_t beam = 1; beam < e.beams(); ++beam)
        if (test::beam_power(e, beam) > test::beam_power(e, best)) best = beam;
    return best;
}

// V3, over the whole of a wide fan.
TEST(Geometry, TargetsStandInTheirBeamAndBin) {
    for (const double c : {1450.0, 1500.0, 1531.0, 1550.0})
        for (double bearing = -64.6; bearing <= 65; bearing += 16) {
            Shot shot = test::fan(130, 20, 130, 400, 40, 1500);  // the device's bins are times, not ranges
            shot.first_bin_time = 2e-3;
            const double range = 17.3 + 0.1 * bearing;
            // Larger than a sample of 0.27 deg: a smaller one is missed by a ping now and then.
            Renderer renderer(scene_of({plate(deg_to_rad(bearing), range, 0.15)}), test::water_of(c),
                              test::boxes());
            const Echogram e = renderer.render(shot, {});
            const std::size_t beam = strongest_beam(e);
            EXPECT_LE(std::abs(shot.bearings[beam] - deg_to_rad(bearing)), shot.beam_width / 2 + 1e-9)
                << bearing;
            const double bin = std::floor((2 * range / c - shot.first_bin_time) / shot.bin_interval);
            EXPECT_NEAR(static_cast<double>(test::strongest_bin(e.beam(beam))), bin, 1)
                << c << " m/s, " << bearing;
            EXPECT_NEAR(e.truth[beam].nearest_range, range, 0.01);
        }
}

TEST(Geometry, FansUpToAFullTurn) {
    const Shot shot = test::fan(360, 20, 180, 200, 40);
    for (const double bearing : {-171.0, -93.0, -31.0, 1.0, 89.0, 179.0}) {
        Renderer renderer(scene_of({plate(deg_to_rad(bearing), 20, 0.5)}), test::water_of(1500),
                          test::boxes());
        const Echogram e = renderer.render(shot, {});
        EXPECT_LE(std::abs(shot.bearings[strongest_beam(e)] - deg_to_rad(bearing)),
                  shot.beam_width / 2 + 1e-9);
    }
}

// A head that pans clockwise by 90 degrees looks to starboard, which is -y; one that tilts up looks up.
TEST(Geometry, PanAndTilt) {
    Shot shot = test::fan(3, 20, 1, 200, 40);
    shot.pan = deg_to_rad(90);
    Renderer starboard(scene_of({plate(deg_to_rad(90), 20, 1)}), test::water_of(1500), test::boxes());
    EXPECT_NEAR(starboard.render(shot, {}).truth[0].axis_range, 20, 0.02);
    shot.pan = 0;
    shot.tilt = deg_to_rad(60);
    Mesh above = test::quad("above", {9, 1, 17.3}, {11, 1, 17.3}, {11, -1, 17.3}, {9, -1, 17.3});
    Renderer up(scene_of({above}), test::water_of(1500), test::boxes());
    EXPECT_NEAR(up.render(shot, {}).truth[0].axis_range, 17.3 / std::sin(deg_to_rad(60)), 0.02);
    shot.tilt = deg_to_rad(-60);
    EXPECT_TRUE(std::isnan(up.render(shot, {}).truth[0].axis_range));
}

// The sonar's pose turns and moves the fan.
TEST(Geometry, PoseOfTheSonar) {
    const Shot shot = test::fan(60, 20, 60, 400, 40);
    const Pose pose{{100, -50, -7}, from_rpy(0, 0, deg_to_rad(90))};  // looks along +y
    Mesh target = plate(deg_to_rad(10), 20, 0.3);
    for (Vec3& p : target.positions) p = pose * p;
    Renderer renderer(scene_of({target}), test::water_of(1500), test::boxes());
    const Echogram e = renderer.render(shot, pose);
    EXPECT_LE(std::abs(shot.bearings[strongest_beam(e)] - deg_to_rad(10)), shot.beam_width / 2 + 1e-9);
    EXPECT_EQ(e.world_from_sonar, pose);
}

// V11: H 5, h 1, x 20: the shadow on the floor goes from x to x + 5.
TEST(Geometry, ShadowLength) {
    const double height = 5, object = 1, ground = 20, bin = 0.05;
    const Mesh plate_up = test::wall_at(ground, 3, -height, -height + object);
    RendererOptions options = test::boxes();
    options.pixel_density = 16;  // at 25 m a pixel of the usual height covers 0.9 m of the floor
    Renderer renderer(scene_of({test::floor_at(-height, 100), plate_up}), test::water_of(1500), options);
    Shot shot = test::fan(5, 30, 5, 800, 40);
    shot.tilt = deg_to_rad(-15);
    const Echogram e = renderer.render(shot, {});
    const auto beam = e.beam(2);
    const auto bin_of = [&](double x) { return static_cast<std::size_t>(std::hypot(x, height) / bin); };
    const std::size_t begin = bin_of(ground), end = bin_of(ground + object * ground / (height - object));
    const double lit = beam[end + 5];
    ASSERT_GT(lit, 0);
    std::size_t last_dark = begin + 10;
    while (beam[last_dark + 1] < lit / 2) ++last_dark;
    EXPECT_NEAR(static_cast<double>(last_dark), static_cast<double>(end), 1);
    for (std::size_t i = begin + 2; i + 1 < end; ++i) EXPECT_LT(beam[i], 1e-3 * lit) << i;
}

// V12: the slant ranges of a wall's top and base, and layover: looking down at a wall that rises to the
// sonar's depth, its top comes before its base.
TEST(Geometry, WallTopArrivesBeforeItsBase) {
    const double bin = 0.05;
    Renderer renderer(scene_of({test::wall_at(10, 5, -8, -1)}), test::water_of(1500), test::boxes());
    Shot shot = test::fan(2, 60, 1, 600, 30);
    shot.tilt = deg_to_rad(-25);
    const Echogram e = renderer.render(shot, {});
    const auto beam = e.beam(0);
    std::size_t first = 0, last = beam.size() - 1;
    while (beam[first] == 0) ++first;
    while (beam[last] == 0) --last;
    EXPECT_NEAR(static_cast<double>(first), std::floor(std::hypot(10, 1) / bin), 1);
    EXPECT_NEAR(static_cast<double>(last), std::floor(std::hypot(10, 8) / bin), 1);
    EXPECT_NEAR(e.truth[0].nearest_range, std::hypot(10, 1), 0.02);
}

// V12: a fan that reaches the nadir hears the bottom first at R = H.
TEST(Geometry, FirstReturnIsAtTheAltitude) {
    for (const double altitude : {2.0, 5.0, 11.3}) {
        Renderer renderer(scene_of({test::floor_at(-altitude, 200)}), test::water_of(1500), test::boxes());
        Shot shot = test::fan(60, 100, 30, 600, 30);
        shot.tilt = deg_to_rad(-45);
        const Echogram e = renderer.render(shot, {});
        const auto beam = e.beam(15);
        std::size_t first = 0;
        while (beam[first] == 0) ++first;
        EXPECT_NEAR(static_cast<double>(first), std::floor(altitude / 0.05), 1);
        EXPECT_NEAR(e.truth[15].nearest_range, altitude, 0.01);
    }
}

// A downward sounder: one round beam at tilt -90.
TEST(Geometry, SounderLooksStraightDown) {
    Renderer renderer(scene_of({test::floor_at(-12, 200)}), test::water_of(1500), test::boxes());
    Shot shot = test::fan(25, 25, 1, 400, 20);
    shot.tilt = deg_to_rad(-90);
    const Echogram e = renderer.render(shot, {});
    EXPECT_NEAR(e.truth[0].axis_range, 12, 0.01);
    EXPECT_NEAR(static_cast<double>(test::strongest_bin(e.beam(0))), 12 / 0.05, 1);
}

// A swath sounder: the fan stands across the track, 1 x 1 deg beams, and the middle of each beam's echo is
// the depth.
TEST(Geometry, SwathOverAFlatFloor) {
    const double altitude = 20;
    Renderer renderer(scene_of({test::floor_at(-altitude, 300)}), test::water_of(1500), test::boxes());
    Shot shot = test::fan(121, 1, 121, 1000, 50);
    const Pose nose_down{{}, axis_angle({0, 1, 0}, std::numbers::pi / 2)};
    const Echogram e = renderer.render(shot, nose_down);
    for (std::size_t beam = 0; beam < e.beams(); ++beam) {
        double power = 0, moment = 0;
        for (std::size_t bin = 0; bin < shot.bins; ++bin) {
            power += e.beam(beam)[bin];
            moment += e.beam(beam)[bin] * e.bin_range(bin);
        }
        const double depth = moment / power * std::cos(shot.bearings[beam]);
        EXPECT_NEAR(depth, altitude, 0.0025 * altitude) << "beam " << beam;
        EXPECT_NEAR(e.truth[beam].axis_range * std::cos(shot.bearings[beam]), altitude, 0.0005 * altitude);
    }
}

TEST(Geometry, NothingWrapsAndNothingPilesUp) {
    Shot shot = test::fan(30, 20, 10, 100, 10);
    Renderer beyond(scene_of({test::wall_at(12, 50, -50, 50)}), test::water_of(1500), test::boxes());
    for (const float v : beyond.render(shot, {}).values) EXPECT_EQ(v, 0);
    shot.first_bin_time = 2 * 5.0 / 1500;
    Renderer before(scene_of({test::wall_at(3, 50, -50, 50)}), test::water_of(1500), test::boxes());
    const Echogram e = before.render(shot, {});
    for (const float v : e.values) EXPECT_EQ(v, 0);
    EXPECT_NEAR(e.truth[5].nearest_range, 3, 0.05);
    Renderer empty(scene_of({test::wall_at(-12, 1, -1, 1)}), test::water_of(1500),
                   test::boxes());  // behind the sonar
    for (const float v : empty.render(shot, {}).values) EXPECT_EQ(v, 0);
}

// A smooth surface sounds the same wherever in the pixels a ping samples.
TEST(Geometry, JitterDoesNotMoveAFloor) {
    Renderer renderer(scene_of({test::floor_at(-5, 200)}), test::water_of(1500), test::boxes());
    Shot shot = test::fan(60, 30, 64, 500, 50);
    shot.tilt = deg_to_rad(-20);
    const Echogram first = renderer.render(shot, {});
    for (shot.ping = 1; shot.ping < 6; ++shot.ping) {
        const Echogram e = renderer.render(shot, {});
        for (std::size_t beam = 0; beam < e.beams(); ++beam)
            for (std::size_t bin = 100; bin < 480; ++bin)
                ASSERT_NEAR(e.beam(beam)[bin] / first.beam(beam)[bin], 1, 0.015) << beam << ", " << bin;
    }
}

TEST(Geometry, TimeZeroShiftsTheBins) {
    Renderer renderer(scene_of({test::wall_at(10.03, 50, -50, 50)}), test::water_of(1500), test::boxes());
    Shot shot = test::fan(1, 1, 1, 100, 5);
    shot.first_bin_time = 2 * 7.0 / 1500;
    EXPECT_EQ(test::strongest_bin(renderer.render(shot, {}).beam(0)), 60U);
}

// A surface that faces away is not there, unless its material is double-sided.
TEST(Geometry, OneSideScatters) {
    Mesh wall = test::wall_at(10, 5, -5, 5);
    for (Vec3& p : wall.positions)
        p.x = -p.x;  // mirrored: now it faces away from a sonar that looks along -x
    const Shot shot = test::fan(10, 10, 1, 100, 20);
    const Pose astern{{}, axis_angle({0, 0, 1}, std::numbers::pi)};
    EXPECT_EQ(test::total_power(Renderer(scene_of({wall}), {}, test::boxes()).render(shot, astern)), 0);
    wall.material.double_sided = true;
    const double both = test::total_power(Renderer(scene_of({wall}), {}, test::boxes()).render(shot, astern));
    const double front = test::total_power(
        Renderer(scene_of({test::wall_at(10, 5, -5, 5)}), {}, test::boxes()).render(shot, {}));
    EXPECT_GT(front, 0);
    EXPECT_NEAR(test::db(both / front), 0, 0.01);
}

}  // namespace
}  // namespace echoloop
