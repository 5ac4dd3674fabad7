// What else bends with the rays: what is culled, patches, what the water sends back, ways by walls and by the
// surface; against rays of their own.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "render/fan/patches.h"
#include "render/fan/plan.h"
#include "render/gl/culling.h"
#include "render/ray_table.h"
#include "render/refraction.h"
#include "tests/render/meshes.h"
#include "tests/render/paths/path_rooms.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using test::db, test::scene_of;
using Profile = std::vector<SoundSpeedPoint>;

const Profile thermocline{{0, 1515}, {10, 1515}, {20, 1485}};
const Profile downward{{0, 1500}, {50, 1350}}, upward{{0, 1400}, {50, 1550}};

Vec3 unit(double bearing, double elevation) {
    return {std::cos(elevation) * std::cos(bearing), std::cos(elevation) * std::sin(bearing),
            std::sin(elevation)};
}

// A plane through the sonar, such as a side of a view: what is seen above it must not be culled.
TEST(BentWater, LiftIsEnoughForWhateverRaysShow) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> angle(-3.14, 3.14), high(-1.5, 1.5), share(0, 1);
    for (const Profile& profile : {thermocline, downward, upward}) {
        const RayTable rays(profile, 8, 60, true);
        int crossed = 0;
        for (int i = 0; i < 200'000; ++i) {
            const double range = 60 * share(random), bearing = angle(random), elevation = high(random);
            const Vec3 line = unit(bearing, elevation);
            if (range * line.z > 8) continue;
            const BentRay ray = rays.at(range * std::cos(elevation), -range * line.z);
            const Vec3 seen = unit(bearing, elevation + ray.turn), normal = unit(angle(random), high(random));
            if (dot(seen, normal) < 0) continue;
            crossed += dot(line, normal) < 0 ? 1 : 0;
            const double lift = rays.lift(range, normal.z < 0);
            ASSERT_GE(dot(line, normal) + std::abs(normal.z) * lift, -1e-6)
                << range << " m, " << rad_to_deg(elevation) << " deg";
        }
        EXPECT_GT(crossed, 100) << "there must be what straight rays would cull";
    }
}

// Upright planes cut the same however rays bend, so a narrow tall view draws no more than with straight ones.
TEST(BentWater, ATallNarrowViewDrawsWhatItDrawsWithStraightRays) {
    const auto scene = scene_of({test::seabed(400)});
    Shot shot = test::fan(1, 100, 1, 1000, 60);
    shot.beam_width = deg_to_rad(0.5);
    const View view = plan_fan(geometry_of(shot, {}), {}).views.front();
    const RayTable rays(thermocline, 8, 60, true);
    const gl::NodeRange all{0, static_cast<std::uint32_t>(scene->nodes().size())};
    const auto drawn = [&](const RayTable* bent) {
        std::vector<std::uint32_t> nodes;
        gl::find_visible(*scene, all, view, Pose{{0, 0, 1}, {}}, {.end_range = 60, .rays = bent}, nodes);
        return static_cast<double>(nodes.size());
    };
    EXPECT_GT(drawn(nullptr), 10);
    EXPECT_LT(drawn(&rays), 1.1 * drawn(nullptr));
}

TEST(BentWater, PlacesAreWhereRaysEnd) {
    for (const Profile& profile : {thermocline, downward, upward})
        for (const double depth : {2.0, 12.0, 30.0}) {
            const RayTable rays(profile, depth, 100, true);
            for (double elevation = -89; elevation < 90; elevation += 3.7)
                for (double length = 3; length < 100; length += 9.3) {
                    const double e = deg_to_rad(elevation);
                    const RayPoint end = ray_after(profile, {0, depth, e}, length / rays.speed());
                    if (end.depth < 0) continue;  // above the surface water goes on otherwise
                    const auto up = static_cast<float>(std::sin(e));
                    const RayTable::Place place = rays.place(up, static_cast<float>(length));
                    EXPECT_NEAR(length * double{place.height(up)}, depth - end.depth, 2e-3 * length)
                        << depth << " m, " << elevation << " deg, " << length << " m";
                    EXPECT_NEAR(length * double{place.along} * std::cos(e), end.distance, 2e-3 * length)
                        << depth << " m, " << elevation << " deg, " << length << " m";
                }
        }
}

TEST(BentWater, TheSurfaceIsMetWhereRaysMeetIt) {
    for (const Profile& profile : {thermocline, downward, upward}) {
        const double depth = 5;
        const RayTable::Surfacing meets = RayTable(profile, depth, 120, true).surfacing();
        const double speed = sound_speed_at(profile, depth);
        int met = 0;
        for (std::size_t i = 0; i < RayTable::Surfacing::places; i += 3) {
            const double root = static_cast<double>(i) / RayTable::Surfacing::half - 1;
            RayPoint ray{0, depth, std::asin(std::clamp(root * std::abs(root), -1.0, 1.0))};
            if (std::abs(root) > 0.99) continue;
            constexpr double step = 1e-5;
            double time = 0;
            while (ray.depth > 0 && time < 0.1) ray = ray_after(profile, ray, step), time += step;
            if (ray.depth > 0) {
                EXPECT_TRUE(meets.inverse[i] == 0 || 1 / double{meets.inverse[i]} > 0.1 * speed) << root;
                continue;
            }
            ++met;
            EXPECT_NEAR(1 / double{meets.inverse[i]}, time * speed, 0.02 + 1e-4 * time * speed) << root;
            EXPECT_NEAR(double{meets.sine[i]}, std::sin(ray.elevation), 1e-3) << root;
        }
        EXPECT_GT(met, 20);
    }
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
    const auto n = static_cast<double>(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) ma += a[i] / n, mb += b[i] / n;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double x = a[i] - ma, y = b[i] - mb;
        aa += x * x, bb += y * y, ab += x * y;
    }
    return ab / std::sqrt(aa * bb);
}

// 40 m off rays come down 2 m farther than straight ones would: two patches.
TEST(BentWater, PatchesLieOnTheFloor) {
    Mesh floor = test::floor_at(-15, 100);
    floor.material.patchiness = 3;
    const auto scene = scene_of({floor});
    RendererOptions options = test::boxes();
    options.effects.set(Effect::beam_pattern).set(Effect::refraction);
    Shot shot = test::fan(30, 24, 120, 1200, 60, 1485);
    shot.tilt = deg_to_rad(-20);
    Water water;
    water.profile = downward;
    const double depth = 5, speed = sound_speed_at(downward, depth);
    const auto values = [&](bool texture) {
        options.effects.set(Effect::texture, texture);
        return Renderer(scene, water, options).render(shot, Pose{{0, 0, -depth}, {}});
    };
    const Echogram with = values(true), without = values(false);
    std::vector<double> found, bent, straight;
    for (std::size_t beam = 0; beam < 120; beam += 3)
        for (std::size_t bin = 0; bin < 1200; bin += 8) {
            const double range = with.bin_range(bin);
            if (range < 33 || range > 45) continue;
            double low = deg_to_rad(-60), high = 0;
            RayPoint end;
            for (int i = 0; i < 50; ++i) {
                const double middle = (low + high) / 2;
                end = ray_after(downward, {0, depth, middle}, range / speed);
                (end.depth > 15 ? low : high) = middle;
            }
            const auto factor_at = [&](double distance) {
                const double b = shot.bearings[beam];
                return db(
                    Patches::factor(floor.material, {distance * std::cos(b), -distance * std::sin(b), -15}));
            };
            found.push_back(db(double{with.beam(beam)[bin]} / double{without.beam(beam)[bin]}));
            bent.push_back(factor_at(end.distance));
            straight.push_back(factor_at(std::sqrt(range * range - 100)));
        }
    ASSERT_GT(found.size(), 500U);
    EXPECT_GT(correlation(found, bent), 0.7);
    EXPECT_LT(correlation(found, straight), correlation(found, bent) - 0.2);
}

/// Mean levels of the water alone.
Echogram water_of(const Profile& profile, std::vector<ScatteringPoint> scattering,
                  std::optional<WaterSurface> surface, double tilt_deg) {
    RendererOptions options = test::boxes();
    for (const Effect effect : {Effect::beam_pattern, Effect::reverberation, Effect::refraction})
        options.effects.set(effect);
    options.surface = surface;
    Water water;
    water.profile = profile, water.scattering = std::move(scattering);
    water.depth = 5;
    Shot shot = test::fan(2, 2, 1, 400, 100, 1485);
    shot.tilt = deg_to_rad(tilt_deg);
    Renderer renderer(scene_of({test::wall_at(-500, 1, -1, 1)}), water, options);
    return renderer.render(shot, Pose{{0, 0, -5}, {}});
}

double loudest(const Echogram& e) { return e.bin_range(test::strongest_bin(e.beam(0))); }

// A level ray drops by q x^2 / 2c: 3 m at 54.5 m, 5 m at 70.4 m.
TEST(BentWater, CloudsAreHeardWhereRaysEnterThem) {
    const std::vector<ScatteringPoint> cloud{{0, -120}, {7.9, -120}, {8, -50}, {10, -50}, {10.1, -120}};
    const Echogram e = water_of(downward, cloud, WaterSurface{}, 0);
    const Echogram straight = water_of({}, cloud, WaterSurface{}, 0);
    const auto level = [](const Echogram& of, double range) {
        return db(double{of.beam(0)[static_cast<std::size_t>(range / 0.25)]});
    };
    EXPECT_GT(level(e, 62), level(e, 50) + 30);
    EXPECT_GT(level(e, 62), level(e, 80) + 30);
    EXPECT_GT(level(e, 62), level(straight, 62) + 5) << "a level line never enters it";
    // Directions share cells of 3.6 deg of elevation: of the cell below, rays enter at 32 m, lines at 48 m.
    EXPECT_GT(level(e, 36), level(straight, 36) + 30);
}

// Rays that rise meet the surface at sqrt(2 c h / q) = 69 m; those that sink never do.
TEST(BentWater, TheWindIsHeardWhereRaysRiseToTheSurface) {
    const WaterSurface windy{.height = 0, .wind = 5};
    const Echogram rising = water_of(upward, {}, windy, 0);
    EXPECT_NEAR(loudest(rising), 65, 8);
    EXPECT_EQ(test::total_power(water_of(downward, {}, windy, 2)), 0);
    EXPECT_GT(test::total_power(water_of({}, {}, windy, 4)), 0) << "a straight ray does, at 72 m";
}

PathEchoes echoes_of(const std::shared_ptr<const Scene>& scene, const RayTable& rays, const Shot& shot) {
    PathTracer tracer(scene, WaterSurface{0, 0}, test::without({Effect::noise}));
    PathEchoes echoes;
    tracer.trace(shot, Pose{{0, 0, -rays.depth()}, {}}, rays.speed(), 0, rays.range(), echoes, {}, {}, &rays);
    return echoes;
}

std::vector<TargetEcho> ways_to(Vec3 target, const Mesh& mirror, const RayTable& rays) {
    const PointTarget point{"target", target, 0};
    const auto scene = Scene::from_meshes(std::span(&mirror, 1), std::span(&point, 1));
    return echoes_of(scene, rays, test::wide_beam(100, 100)).targets;
}

// By a wall at x 40 to a target at x 10, or straight to its image at 70 m, where a ray from 15 m depth sinks.
TEST(BentWater, WaysByWallsGoToBentImages) {
    const RayTable rays(downward, 15, 150, true);
    Mesh wall = test::smooth(test::wall_at(40, 60, -60, -0.1), 0.5);
    const auto ways = ways_to({10, 0, -15}, wall, rays);
    const BentRay image = rays.at(70, 0);
    const double length = 70 * (1 + image.stretch), up = rad_to_deg(image.turn);
    ASSERT_GT(up, 3);
    bool found = false;
    for (const TargetEcho& e : ways) {
        if (e.bounces != 2) continue;
        found |= std::abs(double{e.range} - length) < 0.01 &&
                 std::abs(rad_to_deg(double{e.elevation}) - up) < 0.05;
    }
    EXPECT_TRUE(found);
}

/// Launch elevation (rad) and m of c t of the ray that comes to a point by the surface.
std::pair<double, double> by_surface(const Profile& profile, double depth, double distance, double to) {
    double low = deg_to_rad(0.5), high = deg_to_rad(89);
    double time = 0;
    for (int i = 0; i < 50; ++i) {
        const double middle = (low + high) / 2;
        RayPoint ray{0, depth, middle};
        time = 0;
        bool reflected = false;
        while (ray.distance < distance && time < 1) {
            RayPoint next = ray_after(profile, ray, 2e-5);
            if (!reflected && next.depth < 0)
                next.depth = -next.depth, next.elevation = -next.elevation, reflected = true;
            ray = next, time += 2e-5;
        }
        // The steeper it goes up, the deeper it is then.
        (ray.depth < to ? low : high) = middle;
    }
    return {(low + high) / 2, time * sound_speed_at(profile, depth)};
}

// Straight rays would be 0.29, 0.90 and 1.53 deg too steep for the first three.
TEST(BentWater, WaysByTheSurfaceTakeTheirTimeAndBend) {
    const struct {
        const Profile& profile;
        double depth, x, to;
    } rows[] = {{thermocline, 2, 30, 100},   {thermocline, 2, 95, 100}, {thermocline, 2, 160, 100},
                {thermocline, 12.2, 95, 60}, {thermocline, 14, 120, 8}, {downward, 5.3, 40, 9},
                {downward, 20, 60, 4}};
    const Mesh nothing = test::dull(test::floor_at(-900, 1));
    for (const auto& row : rows) {
        const auto [launch, length] = by_surface(row.profile, row.depth, row.x, row.to);
        const RayTable rays(row.profile, row.depth, 300, true);
        bool found = false;
        for (const TargetEcho& e : ways_to({row.x, 0, -row.to}, nothing, rays)) {
            if (e.bounces != 2) continue;
            found = true;
            EXPECT_NEAR(rad_to_deg(e.elevation), rad_to_deg(launch), 0.1) << row.depth << " m, " << row.x;
            EXPECT_NEAR(e.range / length, 1, 4e-4) << row.depth << " m, " << row.x;
        }
        EXPECT_TRUE(found) << row.depth << " m, " << row.x << " m, " << length;
    }
}

// A strip of the bottom 100 m below the surface and 158 to 162 m off, by way of the surface: rows of a degree
// hear it where rays come from it.
TEST(BentWater, DiffuseEchoesByTheSurfaceBendToo) {
    const auto scene = scene_of({test::dull(
        test::quad("strip", {158, -60, -100}, {162, -60, -100}, {162, 60, -100}, {158, 60, -100}))});
    const auto [launch, length] = by_surface(thermocline, 2, 160, 100);
    const RayTable rays(thermocline, 2, 300, true);
    Shot shot = test::fan(20, 2, 10, 1000, 300, 1515);
    for (double row = 20; row <= 44; row += 1) shot.elevations.push_back(deg_to_rad(row));
    shot.horizontal = shot.vertical = {ApertureShape::line, 2};
    double sum = 0, moment = 0, range = 0;
    for (shot.ping = 0; shot.ping < 8; ++shot.ping)
        for (const PathEcho& e : echoes_of(scene, rays, shot).diffuse) {
            if (!(e.elevation > 0) || std::abs(e.bearing) > 0.1F) continue;
            const double power{e.power};
            sum += power, moment += power * double{e.elevation};
            range += power * double{e.near_range + e.far_range} / 2;
        }
    ASSERT_GT(sum, 0);
    EXPECT_NEAR(rad_to_deg(moment / sum), rad_to_deg(launch), 0.2);
    EXPECT_NEAR(range / sum, length, 2);
}

}  // namespace
}  // namespace echoloop
