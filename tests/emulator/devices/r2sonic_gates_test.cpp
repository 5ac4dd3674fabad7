// What a Sonic makes of where the bottom lies: what its gates exclude, how they slope, and equal distances on
// it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/r2sonic_bench.h"
#include "tests/emulator/devices/seabed_echo.h"
#include "tests/protocols/data.h"

namespace echoloop::test {
namespace {

constexpr std::size_t in_a0 = 648, in_g0 = in_a0 + 36;

/// The next ping's shot and BTH0, its echo that of `bottom` as the head sees it, rolled by `roll` rad.
std::pair<Shot, Bytes> ping_over(Bench& bench, const Bottom& bottom, double roll = 0) {
    while (!bench.ping) bench.run_to(bench.now + 1ms);
    const Ping done = *std::exchange(bench.ping, {});
    Echogram echo = bottom_echo(done.shot, bottom, {});
    if (roll != 0) echo.world_from_sonar = hanging(done.shot, roll, 0).world_from_sonar;
    auto actions = bench.device().heard(echo, done.due);
    bench.now = done.due;
    bench.wake = *actions.wake;
    return {done.shot, named(actions.send, "BTH0").at(0).bytes};
}

/// Points of a sector of 256 beams, as A0 tells it, that lie on the bottom to 1 %.
std::size_t points_on(const Bottom& bottom, const Bytes& b) {
    const double first = f32(b, in_a0 + 4), last = f32(b, in_a0 + 8);
    std::size_t good = 0;
    for (std::size_t n = 0; n < 256; ++n) {
        const double angle = first + (last - first) * static_cast<double>(n) / 255;
        const double time = u16(b, 136 + 2 * n) * static_cast<double>(f32(b, 132));
        good += std::abs(time - 2 * bottom(angle) / 1500) < 0.01 * time;
    }
    return good;
}

TEST(R2SonicGates, OfRangeExcludeWhatLiesOutside) {
    Bench bench = head({{"range", 40.0}});
    bench.run_to(1ms);
    const auto found = [&] {
        ping_over(bench, flat(10));  // the one under way
        const Bytes b = ping_over(bench, flat(10)).second;
        std::size_t good = 0;
        for (std::size_t n = 0; n < 256; ++n) good += u16(b, 136 + 2 * n) != 0;
        return good;
    };
    EXPECT_EQ(found(), 256U);
    for (const auto& [what, value] : {std::pair{"RGA0", 5.0F}, {"RGB0", 14.0F}})
        bench.say(command(what, value));
    EXPECT_EQ(found(), 256U) << "not switched on";
    bench.say(command("RGO0", std::uint32_t{1}));
    const std::size_t within = found();  // 14 m are 44 deg off the axis
    EXPECT_NEAR(static_cast<double>(within), 256 * 44.4 / 60, 10);
    bench.say(command("RGB0", 9.0F));
    EXPECT_EQ(found(), 0U);
}

TEST(R2SonicGates, OfTheUserSlopeDownToStarboard) {
    const Bottom deeper_to_starboard = sloping(10, deg_to_rad(-20));
    for (const double slope : {20.0, -20.0}) {
        Bench bench = head({{"range", 40.0}, {"sector_width", 100.0}});
        for (const auto& [what, value] : {std::pair{"DGA0", 8.0F}, {"DGB0", 12.0F}})
            bench.say(command(what, value));
        bench.say(command("DGS0", static_cast<float>(deg_to_rad(slope))));
        bench.say(command("DGO0", std::uint32_t{1}));
        bench.run_to(1ms);
        ping_over(bench, deeper_to_starboard);  // the one under way
        const Bytes b = ping_over(bench, deeper_to_starboard).second;
        EXPECT_NEAR(rad_to_deg(f32(b, in_g0 + 12)), slope, 1e-4);
        if (slope > 0)
            EXPECT_GT(points_on(deeper_to_starboard, b), 250U);
        else
            EXPECT_LT(points_on(deeper_to_starboard, b), 128U) << "tilted the other way";
    }
}

TEST(R2SonicGates, OfTheirOwnFollowTheDepthAndIfToldToTheSlope) {
    for (const double slope : {0.0, 25.0, -25.0})
        for (const std::uint32_t mode : {0x1402U, 0x1403U}) {  // 20 % of the depth
            Bench bench = head({{"range", 40.0}, {"sector_width", 100.0}});
            bench.say(command("DGO0", mode));
            bench.run_to(1ms);
            const Bottom bottom = sloping(10, deg_to_rad(slope));
            ping_over(bench, bottom);  // the one under way
            ping_over(bench, bottom);  // finds the bottom
            const Bytes b = ping_over(bench, bottom).second;
            EXPECT_NEAR(f32(b, in_g0 + 4), 0.8 * 2 * 10 / 1500, 6e-4) << slope;
            EXPECT_NEAR(f32(b, in_g0 + 8), 1.2 * 2 * 10 / 1500, 6e-4) << slope;
            const bool follows = mode == 0x1403;
            const double told = rad_to_deg(f32(b, in_g0 + 12));
            EXPECT_NEAR(told, follows ? -slope : 0, 1) << "positive where it is deeper to starboard";
            const std::size_t good = points_on(bottom, b);
            if (follows || slope == 0)
                EXPECT_GT(good, 250U) << slope << ' ' << mode;
            else
                EXPECT_LT(good, 200U) << "a level gate loses a slope";
        }
}

TEST(R2SonicGates, OfTheirOwnEngageInASectorThatDoesNotLookDown) {
    for (const float rotation : {55.0F, -55.0F}) {
        Bench bench = head({{"range", 60.0}, {"sector_width", 40.0}});
        bench.say(command("SER0", static_cast<float>(deg_to_rad(rotation))));
        bench.say(command("DGO0", 0x1402U));
        bench.run_to(1ms);
        ping_over(bench, flat(10));  // the one under way
        ping_over(bench, flat(10));  // finds the bottom
        const Bytes b = ping_over(bench, flat(10)).second;
        EXPECT_NEAR(f32(b, in_g0 + 4), 0.8 * 2 * 10 / 1500, 6e-4) << rotation;
        EXPECT_NEAR(f32(b, in_g0 + 8), 1.2 * 2 * 10 / 1500, 6e-4) << rotation;
    }
}

/// Angles that a BTH0 tells with A2, rad.
std::vector<double> angles_of(const Bytes& b) {
    std::vector<double> angles;
    double steps = 0;
    for (std::size_t n = 0; n < 256; ++n) {
        steps += u16(b, 648 + 36 + 2 * n);
        angles.push_back(f32(b, 652) + static_cast<double>(f32(b, 656)) * steps);
    }
    return angles;
}

/// The bottom that a real ping with A2 has found, heard with 1500 m/s.
Bottom bottom_of(const Bytes& b) {
    const std::vector<double> angles = angles_of(b);
    std::vector<double> slants;
    for (std::size_t n = 0; n < 256; ++n) {
        slants.push_back(u16(b, 136 + 2 * n) * static_cast<double>(f32(b, 132)) * 750);
    }
    return [=](double angle) {
        const auto right = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
        const auto n = static_cast<std::size_t>(right - angles.begin());
        const double part = (angle - angles[n - 1]) / (angles[n] - angles[n - 1]);
        return slants[n - 1] + part * (slants[n] - slants[n - 1]);
    };
}

TEST(R2SonicGates, OverTheBottomOfRealPingsSlopeAsTheirs) {
    ECHOLOOP_NEED_DATA(path, "r2sonic/r2sonic_bth0_20.pcap");
    const auto real = read_pcap(*path);
    for (const std::size_t n : {0U, 6U, 13U}) {
        const Bottom bottom = bottom_of(real.at(n));
        Bench bench = head({{"range", 32.0}, {"sector_width", 110.0}});
        bench.say(command("DGO0", 0x1E03U));
        bench.run_to(1ms);
        ping_over(bench, bottom);  // the one under way
        ping_over(bench, bottom);  // finds the bottom
        const double slope = f32(ping_over(bench, bottom).second, in_g0 + 12);
        EXPECT_NEAR(rad_to_deg(slope), rad_to_deg(f32(real[n], 1716 + 12)), 0.3) << "ping " << n;
    }
}

/// Difference of the widest and the narrowest distance between neighbours on a plane whose normal lies at
/// `normal` rad, over their mean.
double spread(const std::vector<double>& angles, double normal) {
    std::vector<double> steps;
    for (std::size_t n = 1; n < angles.size(); ++n)
        steps.push_back(std::tan(angles[n] - normal) - std::tan(angles[n - 1] - normal));
    const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
    const double all = std::tan(angles.back() - normal) - std::tan(angles.front() - normal);
    return (*most - *least) / all * static_cast<double>(steps.size());
}

/// Where the normal of the plane lies on which a ping's beams are equally spaced, rad.
double normal_of(const std::vector<double>& angles) {
    double best = 0;
    for (double normal = -0.3; normal < 0.3; normal += 1e-4)
        if (spread(angles, normal) < spread(angles, best)) best = normal;
    return best;
}

TEST(R2SonicEquiDistance, IsEqualOnTheBottomHoweverItAndTheHeadLean) {
    for (const double roll : {12.0, -12.0})
        for (const double slope : {0.0, 5.0, -5.0})
            for (const std::uint32_t stabilised : {0U, 1U}) {
                Bench bench = head({{"range", 40.0}, {"bottom_mode", std::string("equi-distant")}});
                bench.say(command("ROS0", stabilised));
                bench.run_to(1ms);
                const double normal = deg_to_rad(roll + slope);
                const Bottom bottom = sloping(10, normal);
                const Bottom none = [](double) { return 1000.0; };
                ping_over(bench, none, deg_to_rad(roll));
                const auto without = angles_of(ping_over(bench, bottom, deg_to_rad(roll)).second);
                EXPECT_LT(spread(without, deg_to_rad(roll)), 2e-3) << "level while there is none";
                const auto [shot, told] = ping_over(bench, bottom, deg_to_rad(roll));
                EXPECT_NEAR(rad_to_deg(normal_of(angles_of(told))), roll + slope, 0.1) << stabilised;
                const double middle = stabilised == 1 ? roll : 0, edge = 60.0 * 255 / 256;
                EXPECT_NEAR(rad_to_deg(shot.bearings.front()), middle - edge, 1e-2);
                EXPECT_NEAR(rad_to_deg(shot.bearings.back()), middle + edge, 1e-2);
            }
}

TEST(R2SonicEquiDistance, OnASteepBottomKeepsTheBeamsOfTheWidestSectorInIt) {
    Bench bench = head({{"bottom_mode", std::string("equi-distant")}, {"sector_width", 160.0}});
    bench.run_to(1ms);
    for (int ping = 0; ping < 2; ++ping) ping_over(bench, sloping(10, deg_to_rad(40)));
    const auto bearings = ping_over(bench, sloping(10, deg_to_rad(40))).first.bearings;
    EXPECT_NEAR(rad_to_deg(bearings.front()), -80 * 255.0 / 256, 0.01);
    EXPECT_NEAR(rad_to_deg(bearings.back()), 80 * 255.0 / 256, 0.01);
    EXPECT_TRUE(std::is_sorted(bearings.begin(), bearings.end()));
    EXPECT_LT(spread(bearings, deg_to_rad(85 - 80 * 255.0 / 256)), 0.011) << "85 deg from the normal at most";
}

TEST(R2SonicEquiDistance, IsAsInRealPingsOverTheirBottomAtTheirRoll) {
    ECHOLOOP_NEED_DATA(path, "r2sonic/r2sonic_bth0_20.pcap");
    const auto all = read_pcap(*path);
    for (std::size_t n = 0; n < all.size(); ++n) {
        const Bytes& real = all[n];
        const auto angles = angles_of(real);
        const double roll = f32(real, 648 + 12), normal = normal_of(angles);
        EXPECT_LT(spread(angles, normal), 0.01);
        if (n % 4 != 0) continue;  // they follow each other by 52 ms
        Bench bench =
            head({{"range", 32.0}, {"bottom_mode", std::string("equi-distant")}, {"sector_width", 124.0}});
        bench.say(command("ROS0", std::uint32_t{1}));
        bench.run_to(1ms);
        for (int ping = 0; ping < 2; ++ping) ping_over(bench, bottom_of(real), roll);
        const auto ours = angles_of(ping_over(bench, bottom_of(real), roll).second);
        EXPECT_NEAR(rad_to_deg(ours.front()), rad_to_deg(angles.front()), 0.01) << "the same sector";
        EXPECT_NEAR(rad_to_deg(ours.back()), rad_to_deg(angles.back()), 0.01);
        EXPECT_NEAR(rad_to_deg(normal_of(ours)), rad_to_deg(normal), 0.5);
    }
}

TEST(R2SonicGates, VerboseOnesStandBehindTheOthersForEveryPoint) {
    Bench bench = head({{"range", 15.0}, {"verbose_gates", true}});
    for (const auto& [what, value] : {std::pair{"DGA0", 8.0F}, {"DGB0", 12.0F}})
        bench.say(command(what, value));
    bench.say(command("DGO0", std::uint32_t{1}));
    bench.run_to(100ms);
    const Bytes b = named(bench.sent(), "BTH0").back().bytes;
    const std::size_t g1 = in_g0 + 16;
    EXPECT_EQ(name(b, in_g0, 2) + name(b, g1, 2) + name(b, g1 + 520, 2), "G0G1Q0");
    const double scale = f32(b, g1 + 4);
    EXPECT_NEAR(b.at(g1 + 8 + 2 * 128) * scale, 2 * 8 / 1500.0, scale);
    EXPECT_NEAR(b.at(g1 + 9 + 2 * 128) * scale, 2 * 12 / 1500.0, scale);
    const double outermost = deg_to_rad(60 - 120 / 512.0);
    EXPECT_NEAR(b.at(g1 + 9) * scale, 2 * 12 / 1500.0 / std::cos(outermost), scale) << "the first beam";
}

}  // namespace
}  // namespace echoloop::test
