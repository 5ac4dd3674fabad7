// What a Sonic makes of each command's value: its bounds and where the next ping says it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/r2sonic_bench.h"

namespace echoloop::test {
namespace {

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
        constexpr double half_cell = 70.0 / 256 / 2;  // deg: beams are the middles of what is left's cells
        const double inner = f32(b, in_a0 + (side < 0 ? 8 : 4)), outer = f32(b, in_a0 + (side < 0 ? 4 : 8));
        EXPECT_NEAR(rad_to_deg(inner), side * (10 + half_cell), 1e-3) << "70 deg less half the sector of 120";
        EXPECT_NEAR(rad_to_deg(outer), side * (80 - half_cell), 1e-3);
    }
}

TEST(R2SonicCommands, OfSteeringAreCutToWhatTheFrequencyOfThePingAllows) {
    Bench bench(make_device("r2sonic-2026", {}, {{"trigger", std::string("command")}}));
    const double asked = deg_to_rad(30);
    bench.say(command("TXS0", static_cast<float>(asked)));  // before a frequency that allows 40 deg
    for (const auto& [frequency, most] :
         {std::pair{100e3F, 40.0}, {400e3F, 10.0}, {200e3F, 20.0}, {100e3F, 40.0}}) {
        bench.say(command("FRQ0", frequency));
        bench.say(command("PNG0", std::uint32_t{1}));
        bench.run_to(bench.now + 100ms);
        const Bytes b = named(bench.sent(), "BTH0").back().bytes;
        const double steered = std::min(asked, deg_to_rad(most));
        EXPECT_NEAR(f32(b, in_h0 + 68), steered, 1e-6) << frequency;
        EXPECT_NEAR(bench.shots.back().tilt, steered, 1e-6) << frequency;
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

}  // namespace
}  // namespace echoloop::test
