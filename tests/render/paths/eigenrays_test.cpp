// All rays to a target where they bend: V36 of the reference values, and rays of the test's own.
#include "render/eigenrays.h"

#include <gtest/gtest.h>

#include "render/ray_table.h"
#include "render/refraction.h"
#include "tests/render/paths/path_rooms.h"

namespace echoloop {
namespace {

using Profile = std::vector<SoundSpeedPoint>;

/// c 1490 m/s at 20 m, rising .5 /s both ways.
const Profile duct{{0, 1500}, {20, 1490}, {200, 1580}};

std::vector<Eigenray> rays_to(const RayTable& table, double distance, double below) {
    std::vector<Eigenray> rays;
    Eigenrays(table).find(distance, below, rays);
    return rays;
}

// V36: sonar and target at 20 m, 300 m apart.
TEST(Eigenrays, ADuctHasTheLevelOneAndPairs) {
    const RayTable table(duct, 20, 320, true);
    const auto rays = rays_to(table, 300, 0);
    const auto has = [&](double launch_deg, double ms) {
        return std::ranges::any_of(rays, [&](const Eigenray& ray) {
            return std::abs(rad_to_deg(ray.elevation) - launch_deg) < 2e-3 &&
                   std::abs(ray.length / table.speed() * 1e3 - ms) < 1e-3;
        });
    };
    for (const double side : {-1, 1}) {
        EXPECT_TRUE(has(side * 2.882, 201.257));
        EXPECT_TRUE(has(side * 1.442, 201.321));
    }
    // Those near level arrive together with it.
    EXPECT_NEAR(rays.back().length / table.speed() * 1e3, 201.342, 1e-3);
    EXPECT_LT(std::abs(rad_to_deg(rays.back().elevation)), 0.5);
    EXPECT_LE(rays.size(), 12U);
    EXPECT_TRUE(std::ranges::is_sorted(rays, {}, &Eigenray::length));
}

struct End {
    double below = 0, time = 0;  ///< m, s
    bool surfaced = false;
};

/// In straight steps of so many m, by the bend of a ray where it is.
End follow(const Profile& profile, double depth, double elevation, double distance, double step = 0.05) {
    double x = 0, z = depth, angle = -elevation, time = 0;
    End end;
    while (x < distance) {
        const auto slope = [&](double at) {
            return (sound_speed_at(profile, at + 1e-3) - sound_speed_at(profile, at - 1e-3)) / 2e-3;
        };
        const double middle = z + step / 2 * std::sin(angle), c = sound_speed_at(profile, middle);
        const double turned = angle - step / 2 * slope(z) * std::cos(angle) / c;
        const double part = std::min(1.0, (distance - x) / (step * std::cos(turned)));
        x += part * step * std::cos(turned), z += part * step * std::sin(turned), time += part * step / c;
        angle -= part * step * slope(middle) * std::cos(turned) / c;
        end.surfaced = end.surfaced || z < 0;
        if (part < 1) break;
    }
    end.below = z - depth, end.time = time;
    return end;
}

struct Place {
    const char* name;
    Profile profile;
    double depth, distance, below;
};

const Place places[] = {
    {"duct", duct, 20, 250, 2},
    {"duct, off its axis", duct, 18, 310, 3.3},
    {"in a thermocline", {{0, 1515}, {10, 1515}, {20, 1485}}, 18, 110, 3},
    {"its shadow", {{0, 1515}, {10, 1515}, {20, 1485}}, 15, 200, 4},
    {"below a warm layer", {{0, 1500}, {8, 1504}, {30, 1480}, {60, 1490}}, 25, 330, 12},
    {"above it", {{0, 1500}, {8, 1504}, {30, 1480}, {60, 1490}}, 5, 150, 4},
    {"even gradient", {{0, 1500}, {50, 1475}}, 10, 120, 8},
};

// As many as rays of its own find, and each of them ends where the target is, in its time.
TEST(Eigenrays, AreAllThatLeadThere) {
    for (const Place& place : places) {
        const RayTable table(place.profile, place.depth, 1.2 * place.distance, true);
        const auto rays = rays_to(table, place.distance, place.below);
        for (const Eigenray& ray : rays) {
            const End end = follow(place.profile, place.depth, ray.elevation, place.distance);
            EXPECT_NEAR(end.below, place.below, 0.03) << place.name << ' ' << rad_to_deg(ray.elevation);
            EXPECT_NEAR(ray.length, end.time * table.speed(), 3e-3) << place.name;
            EXPECT_FALSE(end.surfaced) << place.name;
        }
        std::vector<double> launches;
        End last = follow(place.profile, place.depth, -0.3, place.distance);
        for (double elevation = -0.2995; elevation < 0.3; elevation += 5e-4) {
            const End end = follow(place.profile, place.depth, elevation, place.distance);
            const double a = last.below - place.below, b = end.below - place.below;
            if (!last.surfaced && !end.surfaced && (a < 0) != (b < 0) && std::abs(a - b) < 3)
                launches.push_back(elevation);
            last = end;
        }
        for (const double launch : launches)
            EXPECT_TRUE(std::ranges::any_of(rays,
                                            [&](const Eigenray& ray) {
                                                // Those near level are taken for one.
                                                return std::abs(ray.elevation - launch) <
                                                       (std::abs(launch) < 0.01 ? 0.02 : 2e-3);
                                            }))
                << place.name << ' ' << rad_to_deg(launch);
        EXPECT_EQ(rays.empty(), launches.empty()) << place.name;
    }
}

// The tube between two rays beside it.
TEST(Eigenrays, AreAsLoudAsTheirTubes) {
    for (const Place& place : places) {
        const RayTable table(place.profile, place.depth, 1.2 * place.distance, true);
        for (const Eigenray& ray : rays_to(table, place.distance, place.below)) {
            constexpr double beside = 5e-4, step = 0.01;
            const auto at = [&](double elevation) {
                return follow(place.profile, place.depth, elevation, place.distance, step);
            };
            const double height =
                std::abs(at(ray.elevation + beside).below - at(ray.elevation - beside).below);
            const double focus = std::pow(ray.length, 2) * 2 * beside / (place.distance * height);
            if (focus < 0.2 || focus > 5) continue;  // beside a caustic
            EXPECT_NEAR(test::db(ray.focus / focus), 0, 0.5) << place.name;
        }
    }
}

PathEchoes echoes_of(const std::shared_ptr<const Scene>& scene, const RayTable& rays) {
    PathTracer tracer(scene, WaterSurface{0, 0}, test::without({Effect::multipath}));
    PathEchoes echoes;
    tracer.trace(test::wide_beam(20, 20), Pose{{0, 0, -rays.depth()}, {}}, rays.speed(), 0, rays.range(),
                 echoes, {}, {}, &rays);
    return echoes;
}

bool any_at(const PathEchoes& echoes, double range, double launch_deg) {
    return std::ranges::any_of(echoes.targets, [&](const TargetEcho& echo) {
        return std::abs(echo.range - range) < 2e-3 &&
               std::abs(rad_to_deg(echo.elevation) - launch_deg) < 0.01;
    });
}

TEST(Eigenrays, TargetsInADuctAreHeardByAllThatNothingHides) {
    const RayTable table(duct, 20, 320, true);
    const PointTarget target{"target", {300, 0, -20}, 0};
    // Below the level ray at half the way the steepest pair is 3.77 m off it.
    const Mesh low = test::dull(test::wall_at(150, 5, -25, -23)), away = test::dull(test::floor_at(-900, 1));
    const double first = 0.201257 * table.speed(), second = 0.201321 * table.speed();
    for (const bool hidden : {false, true}) {
        const auto echoes =
            echoes_of(Scene::from_meshes(std::span(hidden ? &low : &away, 1), std::span(&target, 1)), table);
        EXPECT_TRUE(any_at(echoes, first, 2.882));
        EXPECT_EQ(any_at(echoes, first, -2.882), !hidden);
        EXPECT_TRUE(any_at(echoes, second, 1.442));
        EXPECT_TRUE(any_at(echoes, second, -1.442));
        EXPECT_TRUE(any_at(echoes, (first + second) / 2, 1.442)) << "there by one and back by another";
    }
}

// V35: one-way spreading.
TEST(Eigenrays, ATargetIsAsLoudAsItsRaySpreads) {
    const RayTable table(Profile{{0, 1515}, {10, 1515}, {20, 1485}}, 2, 300, true);
    struct Row {
        double launch_deg, x, spreading_db;
    };
    for (const Row& row : {Row{45, 94.73, -42.48}, {60, 159.00, -45.11}}) {
        const PointTarget target{"target", {row.x, 0, -100}, 0};
        const Mesh away = test::dull(test::floor_at(-900, 1));
        PathTracer tracer(Scene::from_meshes(std::span(&away, 1), std::span(&target, 1)), WaterSurface{0, 0},
                          test::without({Effect::multipath}));
        Shot shot = test::wide_beam(20, 20);
        shot.tilt = deg_to_rad(row.launch_deg - 90);
        PathEchoes echoes;
        tracer.trace(shot, Pose{{0, 0, -2}, {}}, table.speed(), 0, table.range(), echoes, {}, {}, &table);
        ASSERT_EQ(echoes.targets.size(), 1U);
        EXPECT_NEAR(test::db(echoes.targets[0].power) - shot.source_level, 2 * row.spreading_db, 0.06);
    }
}

}  // namespace
}  // namespace echoloop
