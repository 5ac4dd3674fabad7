// What a Sonic makes of each command's value: its bounds, where the next ping says it, and what gates
// exclude.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/r2sonic_bench.h"
#include "tests/emulator/devices/seabed_echo.h"

namespace echoloop::test {
namespace {

/// The next ping's shot and BTH0, its echo that of `bottom`.
std::pair<Shot, Bytes> ping_over(Bench& bench, const Bottom& bottom) {
    while (!bench.ping) bench.run_to(bench.now + 1ms);
    const Ping done = *std::exchange(bench.ping, {});
    auto actions = bench.device().heard(bottom_echo(done.shot, bottom, {}), done.due);
    bench.now = done.due;
    bench.wake = *actions.wake;
    return {done.shot, named(actions.send, "BTH0").at(0).bytes};
}

struct Bounds {
    const char* name;
    double low, high;
    std::size_t at;  // of what the next ping's BTH0 says of it
};
constexpr std::size_t in_h0 = 12, in_a0 = 648, in_g0 = 648 + 36;

TEST(R2SonicCommands, AreCutToTheirBoundsAndStandInTheNextPing) {
    const double degree = deg_to_rad(1);
    const Bounds table[] = {{"RNG0", 2, 1200, in_h0 + 88},
                            {"FRQ0", 200e3, 700e3, in_h0 + 48},
                            {"TXP0", 0, 221, in_h0 + 52},
                            {"TXL0", 10e-6, 1115e-6, in_h0 + 56},
                            {"TXS0", -10 * degree, 10 * degree, in_h0 + 68},
                            {"GAN0", 1, 45, in_h0 + 92},
                            {"SPR0", 0, 60, in_h0 + 96},
                            {"ABS0", 0, 200, in_h0 + 100},
                            {"RET0", -45 * degree, 45 * degree, in_h0 + 104},
                            {"SVL0", 1250, 1600, in_h0 + 44},
                            {"PRZ0", -0.2, 0.2, in_a0 + 16},
                            {"DGS0", -90 * degree, 90 * degree, in_g0 + 12}};
    for (const Bounds& row : table)
        for (const double side : {-1.0, 0.0, 1.0}) {
            Bench bench = head({{"trigger", std::string("command")}});
            for (const char* on : {"SVU0", "DGO0"}) bench.say(command(on, std::uint32_t{1}));
            const double within = 0.4 * row.low + 0.6 * row.high;
            bench.say(command(row.name, static_cast<float>(side == 0 ? within : side * 1e9)));
            bench.say(command("PNG0", std::uint32_t{1}));
            bench.run_to(2s);
            const Bytes b = named(bench.sent(), "BTH0").at(0).bytes;
            double expected = side < 0 ? row.low : side > 0 ? row.high : within;
            if (row.name == std::string("FRQ0") && side == 0) expected = 400e3;  // the nearest of the model
            if (row.name == std::string("TXP0") && side == 0) expected = 191;
            EXPECT_NEAR(f32(b, row.at), expected, 1e-6 * std::abs(expected) + 1e-12) << row.name << side;
        }
}

TEST(R2SonicCommands, RotateTheSectorWithinEightyDegrees) {
    for (const double side : {-1.0, 1.0}) {
        Bench bench = head({{"trigger", std::string("command")}});
        bench.say(command("SER0", static_cast<float>(side * 1e9)));
        bench.say(command("PNG0", std::uint32_t{1}));
        bench.run_to(100ms);
        const Bytes b = named(bench.sent(), "BTH0").at(0).bytes;
        const double inner = f32(b, in_a0 + (side < 0 ? 8 : 4)), outer = f32(b, in_a0 + (side < 0 ? 4 : 8));
        EXPECT_NEAR(rad_to_deg(inner), side * 10, 1e-3) << "70 deg less half the sector of 120";
        EXPECT_NEAR(rad_to_deg(outer), side * 80, 1e-3);
    }
}

TEST(R2SonicCommands, OfProjectorAndReceiverChangeTheShot) {
    Bench bench = head({{"trigger", std::string("command")}});
    const auto ping = [&](const std::vector<Bytes>& commands) {
        for (const Bytes& one : commands) bench.say(one);
        bench.say(command("PNG0", std::uint32_t{1}));
        bench.run_to(bench.now + 100ms);
        return std::pair{bench.shots.back(), named(bench.sent(), "BTH0").back().bytes};
    };
    const Shot plain = ping({}).first;
    const auto [wide, b] =
        ping({command("PROJ", std::uint32_t{2}), command("PRX0", 0.25F), command("PRY0", -0.5F)});
    EXPECT_NEAR(rad_to_deg(wide.fan_height), 20, 1e-9);
    EXPECT_NEAR(f32(b, in_h0 + 60), deg_to_rad(20), 1e-6);
    EXPECT_FLOAT_EQ(f32(b, in_a0 + 16), 0.119F) << "Z, Y, X";
    EXPECT_FLOAT_EQ(f32(b, in_a0 + 20), -0.5F);
    EXPECT_FLOAT_EQ(f32(b, in_a0 + 24), 0.25F);
    const Shot kaiser = ping({command("TXW0", std::uint32_t{1})}).first;
    EXPECT_NEAR(kaiser.source_level, plain.source_level - 2.3, 1e-9);
    const Shot tilted = ping({command("RET0", 0.2F), command("TXS0", 0.1F)}).first;
    EXPECT_NEAR(tilted.tilt, 0.3, 1e-6);
    EXPECT_EQ(plain.tilt, 0);
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
            EXPECT_NEAR(rad_to_deg(f32(b, in_g0 + 12)), follows ? slope : 0, 1);
            std::size_t good = 0;
            for (std::size_t n = 0; n < 256; ++n) {
                const double angle = deg_to_rad(-50 + 100.0 * static_cast<double>(n) / 255);
                const double time = u16(b, 136 + 2 * n) * static_cast<double>(f32(b, 132));
                good += std::abs(time - 2 * bottom(angle) / 1500) < 0.01 * time;
            }
            if (follows || slope == 0)
                EXPECT_GT(good, 250U) << slope << ' ' << mode;
            else
                EXPECT_LT(good, 200U) << "a level gate loses a slope";
        }
}

}  // namespace
}  // namespace echoloop::test
