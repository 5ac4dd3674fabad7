// What the gates of a Sonic exclude, where it tells them, and which way they slope.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/r2sonic_bench.h"
#include "tests/emulator/devices/seabed_echo.h"
#include "tests/protocols/data.h"

namespace echoloop::test {
namespace {

constexpr std::size_t in_a0 = 648, in_g0 = in_a0 + 36;

/// The next ping's shot and BTH0, its echo that of `bottom`.
std::pair<Shot, Bytes> ping_over(Bench& bench, const Bottom& bottom) {
    while (!bench.ping) bench.run_to(bench.now + 1ms);
    const Ping done = *std::exchange(bench.ping, {});
    auto actions = bench.device().heard(bottom_echo(done.shot, bottom, {}), done.due);
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

/// The bottom that a real ping with A2 has found, heard with 1500 m/s.
Bottom bottom_of(const Bytes& b) {
    std::vector<double> angles, slants;
    double steps = 0;
    for (std::size_t n = 0; n < 256; ++n) {
        steps += u16(b, 648 + 36 + 2 * n);
        angles.push_back(f32(b, 652) + static_cast<double>(f32(b, 656)) * steps);
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
    EXPECT_NEAR(b.at(g1 + 9) * scale, 2 * 12 / 1500.0 / std::cos(deg_to_rad(60)), scale) << "60 deg to port";
}

}  // namespace
}  // namespace echoloop::test
