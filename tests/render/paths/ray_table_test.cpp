// Bent rays against values of an independent script: V34 to V36 of the reference values.
#include "render/ray_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/layered_ray.h"
#include "render/pose.h"
#include "render/refraction.h"

namespace echoloop {
namespace {

using Profile = std::vector<SoundSpeedPoint>;

const Profile thermocline{{0, 1515}, {10, 1515}, {20, 1485}};

struct Arrival {
    double distance, time, arrival;  // m, s, rad
};

/// Where a ray first comes to a depth, by arcs.
Arrival arrival_at(const Profile& profile, double from, double elevation, double to) {
    double low = 0, high = 100;
    for (int i = 0; i < 200; ++i) {
        const double middle = (low + high) / 2;
        (ray_after(profile, {0, from, elevation}, middle).depth < to ? low : high) = middle;
    }
    const RayPoint end = ray_after(profile, {0, from, elevation}, high);
    return {end.distance, high, end.elevation};
}

/// What a table says of a point: launch elevation (rad), time (s) and elevation of arrival.
struct Seen {
    double launch, time, arrival;
};
Seen seen(const RayTable& table, double distance, double depth) {
    const double below = depth - table.depth();
    const BentRay ray = table.at(distance, below);
    const double launch = std::atan2(-below, distance) + ray.turn;
    return {launch, std::hypot(distance, below) * (1 + ray.stretch) / table.speed(), launch + ray.bow};
}

// V35: the table of one-way rays to a bottom at 100 m below a thermocline.
struct Row {
    double launch_deg, x, ms, arrival_deg;
};
constexpr Row below_thermocline[] = {{0, 0, 65.820, 0},
                                     {10, 16.97, 66.799, 9.80},
                                     {20, 34.98, 69.886, 19.59},
                                     {30, 55.30, 75.574, 29.35},
                                     {40, 79.87, 84.910, 39.05},
                                     {45, 94.73, 91.540, 43.88},
                                     {50, 112.13, 100.015, 48.67},
                                     {60, 159.00, 125.438, 58.09},
                                     {65, 192.29, 144.944, 62.67},
                                     {70, 236.67, 172.022, 67.08}};

TEST(RayTable, ArcsMeetTheBottomBelowAThermoclineAsPublished) {
    for (const Row& row : below_thermocline) {
        const Arrival got = arrival_at(thermocline, 2, deg_to_rad(row.launch_deg - 90), 100);
        EXPECT_NEAR(got.distance, row.x, 0.02) << row.launch_deg;
        EXPECT_NEAR(got.time * 1e3, row.ms, 0.002) << row.launch_deg;
        EXPECT_NEAR(90 + rad_to_deg(got.arrival), row.arrival_deg, 0.02) << row.launch_deg;
    }
}

TEST(RayTable, TablesTheBottomBelowAThermocline) {
    const RayTable table(thermocline, 2, 300, true);
    EXPECT_EQ(table.speed(), 1515);
    for (const Row& row : below_thermocline) {
        const Seen got = seen(table, row.x, 100);
        EXPECT_NEAR(90 + rad_to_deg(got.launch), row.launch_deg, 0.02) << row.x;
        EXPECT_NEAR(got.time * 1e3 / row.ms, 1, 2e-4) << row.x;
        EXPECT_NEAR(90 + rad_to_deg(got.arrival), row.arrival_deg, 0.03) << row.x;
        EXPECT_GT(table.at(row.x, 98).clearance, 0);
    }
}

TEST(RayTable, SpreadsBelowAThermoclineAsPublished) {
    const RayTable table(thermocline, 2, 300, true);
    for (const auto& [launch, ms, spread] : {std::array{45.0, 91.540, -42.48}, {60.0, 125.438, -45.11}}) {
        const double length = ms / 1e3 * 1515;
        const double focus =
            table.focus(-static_cast<float>(std::cos(deg_to_rad(launch))), static_cast<float>(length));
        EXPECT_NEAR(10 * std::log10(focus / (length * length)), spread, 0.05) << launch;
    }
    EXPECT_TRUE(table.focuses());
}

// V34: constant gradient.
TEST(RayTable, ConstantGradient) {
    const Profile down{{0, 1550}, {100, 1500}, {400, 1350}};
    const auto drop = [&](double elevation, double distance) {
        double low = 0, high = 1;
        for (int i = 0; i < 100; ++i) {
            const double middle = (low + high) / 2;
            (ray_after(down, {0, 100, elevation}, middle).distance < distance ? low : high) = middle;
        }
        return std::pair(ray_after(down, {0, 100, elevation}, high), high);
    };
    EXPECT_NEAR(drop(0, 60).first.depth - 100, 0.6001, 1e-3);
    EXPECT_NEAR(drop(0, 300).first.depth - 100, 15.038, 1e-3);
    EXPECT_NEAR(drop(0, 300).second * 1e3, 200.671, 1e-3);
    EXPECT_NEAR(rad_to_deg(drop(0, 300).first.elevation), -5.739, 1e-3);
    EXPECT_NEAR(drop(deg_to_rad(-10), 60).first.depth - 100, 11.2005, 1e-3);
    EXPECT_NEAR(drop(deg_to_rad(-10), 300).first.depth - 100, 68.684, 1e-3);
    const RayTable table(down, 100, 400, false);
    const Seen got = seen(table, 300, 115.038);
    EXPECT_NEAR(rad_to_deg(got.launch), 0, 0.01);
    EXPECT_NEAR(got.time * 1e3, 200.671, 2e-3);
    EXPECT_NEAR(rad_to_deg(got.arrival), -5.739, 0.01);
    EXPECT_NEAR(rad_to_deg(seen(table, 300, 168.684).launch), -10, 0.01);
}

/// m, where the shadow begins at the sonar's depth.
double shadow_edge(const RayTable& table) {
    double x = 1;
    while (x < table.range() && table.at(x, 0).clearance >= 0) x += 0.1;
    return x;
}

TEST(RayTable, ShadowBeginsWhereTheRayTouchesTheSurface) {
    EXPECT_NEAR(shadow_edge(RayTable(Profile{{0, 1500}, {100, 1450}}, 5, 500, true)), 346.27, 1);
    EXPECT_NEAR(shadow_edge(RayTable(Profile{{0, 1500}, {50, 1350}}, 5, 250, true)), 141.07, 1);
    EXPECT_EQ(RayTable(Profile{{0, 1500}, {100, 1450}}, 5, 500, false).straight_error(100) > 1, true);
    EXPECT_TRUE(std::isinf(RayTable(Profile{{0, 1500}, {100, 1450}}, 5, 500, true).straight_error(400)));
}

// V36: a duct has several ways to a target on its axis; the table has the first.
TEST(RayTable, FirstOfTheRaysInADuct) {
    const Profile duct{{0, 1500}, {20, 1490}, {60, 1510}};
    for (const auto& [launch, ms] : {std::pair(2.882, 201.257), {1.442, 201.321}}) {
        double low = 0.19, high = 0.21;
        for (int i = 0; i < 60; ++i) {
            const double middle = (low + high) / 2;
            (ray_after(duct, {0, 20, deg_to_rad(launch)}, middle).distance < 300 ? low : high) = middle;
        }
        const RayPoint end = ray_after(duct, {0, 20, deg_to_rad(launch)}, high);
        EXPECT_NEAR(high * 1e3, ms, 1e-3);
        EXPECT_NEAR(end.depth, 20, 0.02) << launch;
    }
    EXPECT_NEAR(300.0 / 1490 * 1e3, 201.342, 1e-3);
    const RayTable table(duct, 20, 400, true);
    const BentRay first = table.at(300, 0);
    EXPECT_NEAR(300 * (1 + first.stretch) / 1490 * 1e3, 201.257, 0.1);
}

double munk(double z) {
    const double e = 2 * (z - 1300) / 1300;
    return 1500 * (1 + 0.00737 * (e - 1 + std::exp(-e)));
}
Profile munk_profile() {
    Profile all;
    for (int z = 0; z <= 5000; z += 6) all.push_back({double(z), munk(z)});
    return all;
}

TEST(RayTable, MunksProfile) {
    const Profile water = munk_profile();
    for (const auto& [deg, top, bottom, cycle] :
         {std::array{5.0, 733.9, 2095.8, 49.67}, {10.0, 304.6, 3279.6, 56.17}}) {
        double least = 1e9, most = 0, turned_up = 0, end = 0;
        RayPoint ray{0, 1300, deg_to_rad(deg)};
        for (int i = 0; i < 5000 && end == 0; ++i) {
            const RayPoint next = ray_after(water, ray, 0.01);
            least = std::min(least, next.depth), most = std::max(most, next.depth);
            if (ray.elevation < 0 && next.elevation >= 0) turned_up = 1;
            if (turned_up > 0 && next.depth <= 1300) end = next.distance;
            ray = next;
        }
        EXPECT_NEAR(least, top, 0.5);
        EXPECT_NEAR(most, bottom, 0.5);
        EXPECT_NEAR(end / 1e3, cycle, 0.02);
    }
    const std::array<std::array<double, 3>, 4> down{
        {{0, 0, 2.63877}, {30, 2239.92, 3.02521}, {45, 3826.02, 3.65361}, {60, 6371.85, 4.96716}}};
    const RayTable table(water, 5, 8000, true);
    for (const auto& [deg, x, t] : down) {
        const Arrival got = arrival_at(water, 5, deg_to_rad(deg - 90), 4000);
        EXPECT_NEAR(got.distance, x, 0.1);
        EXPECT_NEAR(got.time, t, 1e-4);
        EXPECT_NEAR(seen(table, x, 4000).time / t, 1, 1e-3);
        EXPECT_NEAR(90 + rad_to_deg(seen(table, x, 4000).launch), deg, 0.1);
    }
}

// Everywhere within a table, against rays of their own: below 0.1 % of time and 0.1 deg.
TEST(RayTable, IsNearToRaysEverywhere) {
    const Profile waters[] = {thermocline,
                              {{0, 1500}, {400, 1300}},
                              {{0, 1480}, {30, 1500}, {60, 1490}, {300, 1494}},
                              {{0, 1540}, {5, 1538}, {12, 1500}, {40, 1490}, {80, 1489}}};
    for (const Profile& profile : waters)
        for (const double depth : {0.5, 11.0, 30.0})
            for (const double range : {30.0, 300.0}) {
                const RayTable table(profile, depth, range, true);
                int compared = 0, turned = 0, moved = 0;
                for (double e = -89.5; e < 89; e += 1.3)
                    for (double share = 0.05; share < 1; share += 0.1) {
                        const double time = share * range / table.speed();
                        const RayPoint end = ray_after(profile, {0, depth, deg_to_rad(e)}, time);
                        if (end.depth < 0.1 || end.distance < 0.01) continue;
                        const BentRay there = table.at(end.distance, end.depth - depth);
                        const BentRay next = table.at(end.distance + table.column_step(), end.depth - depth);
                        // Nothing is claimed beside shadows and where another ray was first.
                        if (there.clearance <= 0 || next.clearance <= 0) continue;
                        const Seen got = seen(table, end.distance, end.depth);
                        if (got.time < time * (1 - 1e-5)) continue;
                        ++compared;
                        ASSERT_NEAR(got.time / time, 1, 1e-3) << depth << " " << range << " " << e << " x "
                                                              << end.distance << " z " << end.depth;
                        turned += std::abs(rad_to_deg(got.launch) - e) > 0.1 ? 1 : 0;
                        const RayTable::Move move = table.move(end.distance, end.depth - depth);
                        const double level = (1 + static_cast<double>(move.outwards)) * end.distance,
                                     height = depth - end.depth + static_cast<double>(move.rise);
                        ASSERT_NEAR(std::hypot(level, height) / (share * range), 1, 1e-3)
                            << depth << " " << range << " " << e << " x " << end.distance;
                        ASSERT_NEAR(static_cast<double>(move.bow) * level, there.bow, 1e-3);
                        moved += std::abs(rad_to_deg(std::atan2(height, level)) - e) > 0.1 ? 1 : 0;
                    }
                EXPECT_GT(compared, 300) << depth << " " << range;
                EXPECT_LE(turned, compared / 100) << "but for rays that only just touch a layer";
                EXPECT_LE(moved, compared / 100) << "the same";
            }
}

TEST(RayTable, EvenWaterBendsNothing) {
    const RayTable table(Profile{{0, 1480}}, 10, 100, true);
    EXPECT_LT(table.straight_error(100), 1e-4);
    EXPECT_FALSE(table.focuses());
    EXPECT_FALSE(table.has_shadow());
}

}  // namespace
}  // namespace echoloop
