// Diffuse echoes by way of a mirror against integrals over the scattering plane, which know nothing of rays.
#include <gtest/gtest.h>

#include <array>

#include "render/acoustics/pattern.h"
#include "tests/render/paths/gentle_seabed.h"
#include "tests/render/paths/path_rooms.h"

namespace echoloop {
namespace {

constexpr double depth = 3, water_depth = 8, mu_db = -20, end_range = 40;
const Pose sonar{{0, 0, -depth}, {}};

/// Amplitude of one way in a direction of the sonar's frame.
using Pattern = std::function<double(Vec3)>;

/// Power per range class: up to 10, 20 and 40 m.
using Powers = std::array<double, 3>;
std::size_t class_of(double range) { return range < 10 ? 0 : range < 20 ? 1 : 2; }

/// Sum over squares of the bottom z = -8 m: by way of the mirror z = 0 there, back or both. Of the two legs
/// one at least is in `cells`, the part of the lobe that is filled with rays.
Powers integral(const Pattern& pattern, const std::function<bool(Vec3)>& cells, double reflection) {
    Powers sum{};
    const double step = 0.3, mu = db_to_power(mu_db);
    for (double x = -80 + step / 2; x < 80; x += step)
        for (double y = -80 + step / 2; y < 80; y += step) {
            const Vec3 down{x, y, depth - water_depth}, up{x, y, depth + water_depth};
            const double r = norm(down), l = norm(up);
            const Vec3 d = 1 / r * down, i = 1 / l * up;
            if (!cells(d) && !cells(i)) continue;
            const double td = pattern(d), ti = pattern(i), there_and_back = 2 * td * ti;
            const double area = 1e20 * mu * step * step;
            if ((r + l) / 2 < end_range)
                sum[class_of((r + l) / 2)] +=
                    area * std::pow(reflection * there_and_back / (r * l), 2) * -d.z * i.z;
            if (l < end_range)
                sum[class_of(l)] +=
                    area * std::pow(reflection * reflection * ti * ti / (l * l), 2) * i.z * i.z;
        }
    return sum;
}

/// Mean over pings; an echo's power is spread evenly over its stretch.
Powers traced(const std::shared_ptr<const Scene>& scene, std::optional<WaterSurface> surface, Effects effects,
              Shot shot) {
    Powers sum{};
    PathTracer tracer(scene, surface, effects);
    constexpr int pings = 1600, parts = 8;
    for (int ping = 0; ping < pings; ++ping) {
        shot.ping = static_cast<std::uint64_t>(ping);
        PathEchoes echoes;
        tracer.trace(shot, sonar, test::sound, 0, end_range, echoes);
        for (const PathEcho& echo : echoes.diffuse)
            for (int part = 0; part < parts; ++part)
                sum[class_of(std::lerp(echo.near_range, echo.far_range, (part + 0.5) / parts))] +=
                    echo.power / parts / pings;
    }
    return sum;
}

/// Of each class that holds more than a tenth, and of all together.
void expect_same(const Powers& ours, const Powers& exact) {
    const auto total = [](const Powers& p) { return p[0] + p[1] + p[2]; };
    EXPECT_NEAR(test::db(total(ours)), test::db(total(exact)), 0.3);
    for (std::size_t i = 0; i < ours.size(); ++i) {
        if (exact[i] < total(exact) / 10) continue;
        EXPECT_NEAR(test::db(ours[i]), test::db(exact[i]), 0.5) << "class " << i;
    }
}

const auto bottom = test::scene_of({test::dull(test::floor_at(-water_depth, 100, 20), mu_db)});
const Effects boxes = test::without({Effect::beam_pattern});

double bearing_of(Vec3 d) { return std::atan2(-d.y, d.x); }

TEST(DiffusePaths, PowerOfAMirrorOverALambertPlane) {
    const Shot shot = test::wide_beam(60, 100);
    const auto inside = [](Vec3 d) {
        return std::abs(std::asin(d.z)) < deg_to_rad(50) && std::abs(bearing_of(d)) < deg_to_rad(30);
    };
    const auto box = [&](Vec3 d) { return inside(d) ? 1.0 : 0.0; };
    expect_same(traced(bottom, WaterSurface{}, boxes, shot), integral(box, inside, 1));
}

// The same mirror, made of triangles: smooth ice.
TEST(DiffusePaths, MirrorOfTrianglesIsNoOther) {
    const Shot shot = test::wide_beam(60, 100);
    const auto inside = [](Vec3 d) {
        return std::abs(std::asin(d.z)) < deg_to_rad(50) && std::abs(bearing_of(d)) < deg_to_rad(30);
    };
    const auto ice =
        test::smooth(test::quad("ice", {-100, -100, 0}, {-100, 100, 0}, {100, 100, 0}, {100, -100, 0}), 0.7);
    const auto scene = test::scene_of({test::dull(test::floor_at(-water_depth, 100, 20), mu_db), ice});
    const auto box = [&](Vec3 d) { return inside(d) ? 1.0 : 0.0; };
    expect_same(traced(scene, {}, boxes, shot), integral(box, inside, 0.7));
}

// A fan that looks down reaches the surface through its side lobes only, on the way there or on the way back.
TEST(DiffusePaths, SurfaceIsHeardThroughSideLobes) {
    Shot shot = test::fan(40, 30, 1, 500, 50);
    shot.tilt = deg_to_rad(-35);
    const TwoWayPattern across(shot.horizontal, shot.beam_width), along(shot.vertical, shot.fan_height);
    const auto in_fan = [&](Vec3 d) {
        const double c = std::cos(shot.tilt), s = std::sin(shot.tilt);
        return Vec3{c * d.x + s * d.z, d.y, c * d.z - s * d.x};
    };
    const auto pattern = [&](Vec3 d) {
        const double cone = std::asin(-in_fan(d).y);
        const double angle = in_fan(d).x < 0 ? std::numbers::pi - std::abs(cone) : cone;
        return across.amplitude(angle) * along.amplitude(std::asin(in_fan(d).z));
    };
    const auto cells = [&](Vec3 d) {
        return std::abs(bearing_of(in_fan(d))) < across.aperture().first_null() &&
               std::abs(std::asin(in_fan(d).z)) < along.aperture().first_null();
    };
    expect_same(traced(bottom, WaterSurface{}, Effects{}, shot), integral(pattern, cells, 1));
}

TEST(DiffusePaths, EchoesCoverAStretchBehindTheFirstReturn) {
    const auto echoes =
        test::trace(bottom, WaterSurface{}, boxes, test::wide_beam(60, 100), sonar, 0, end_range);
    ASSERT_FALSE(echoes.diffuse.empty());
    for (const PathEcho& echo : echoes.diffuse) {
        EXPECT_LE(echo.near_range, echo.far_range);
        EXPECT_GT(echo.near_range, water_depth - depth);
        EXPECT_GT(echo.power, 0);
    }
}

TEST(DiffusePaths, NothingWithoutAMirror) {
    const Shot shot = test::wide_beam(60, 100);
    EXPECT_TRUE(test::trace(bottom, {}, boxes, shot, sonar).diffuse.empty());
    EXPECT_FALSE(test::trace(bottom, WaterSurface{}, boxes, shot, sonar).diffuse.empty());
    // Waves of 1 cm leave nothing of a wave of 2 mm.
    EXPECT_TRUE(
        test::trace(bottom, WaterSurface{0, 0.01}, boxes, test::wide_beam(60, 60), sonar).diffuse.empty());
}

TEST(DiffusePaths, SamePingGivesTheSameEchoes) {
    Shot shot = test::forward_looking();
    shot.tilt = 0;
    const auto first = test::trace(bottom, WaterSurface{}, Effects{}, shot, sonar);
    const auto again = test::trace(bottom, WaterSurface{}, Effects{}, shot, sonar);
    ASSERT_EQ(first.diffuse.size(), again.diffuse.size());
    ASSERT_GT(first.diffuse.size(), 100U);
    for (std::size_t i = 0; i < first.diffuse.size(); ++i) {
        EXPECT_EQ(first.diffuse[i].power, again.diffuse[i].power);
        EXPECT_EQ(first.diffuse[i].near_range, again.diffuse[i].near_range);
    }
    shot.ping = 1;
    EXPECT_NE(test::trace(bottom, WaterSurface{}, Effects{}, shot, sonar).diffuse[0].power,
              first.diffuse[0].power);
}

// Of a scene of more than half a million triangles stand-ins do for indirect echoes: 498,002 and 502,002
// triangles of one bottom sound the same.
TEST(DiffusePaths, StandInsOfALargeSceneSoundAsItself) {
    const Shot shot = test::wide_beam(60, 100);
    const auto of = [&](int cells) {
        Powers powers = traced(test::scene_of({test::gentle_seabed(cells)}), WaterSurface{}, boxes, shot);
        for (double& power : powers) power = test::db(power);
        return powers;
    };
    const Powers all = of(499), stand_ins = of(501);
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_NEAR(all[i], stand_ins[i], 0.1) << "class " << i;
}

}  // namespace
}  // namespace echoloop
