// What the models of the Sonic series can, and the modes in which they ping: triggers, MultiMode,
// stabilisation, density, the SIM.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

#include "tests/emulator/devices/r2sonic_bench.h"
#include "tests/emulator/devices/seabed_echo.h"

namespace echoloop::test {
namespace {

const std::vector<std::string> with_sim{"udp-listen://127.0.0.1:65500", "udp://127.0.0.1:65400",
                                        "udp-listen://127.0.0.1:65300"};

struct Row {
    const char* model;
    double beam, fan;           // deg at 400 kHz
    double asked, transmitted;  // Hz
    double widest;              // deg
    double longest_pulse;       // s
};
void PrintTo(const Row& row, std::ostream* out) { *out << row.model << " " << row.asked; }

class SonicSeries : public testing::TestWithParam<Row> {};

TEST_P(SonicSeries, HasItsOwnNameBeamsBandSectorAndPulse) {
    const Row& row = GetParam();
    Bench bench(make_device(row.model));
    bench.run_to(1ms);
    EXPECT_NEAR(rad_to_deg(bench.ping->shot.beam_width), row.beam, 1e-9);
    EXPECT_NEAR(rad_to_deg(bench.ping->shot.fan_height), row.fan, 1e-9);
    bench.say(command("FRQ0", static_cast<float>(row.asked)));
    bench.say(command("SEW0", 3.0F));
    bench.say(command("TXL0", 1.0F));
    bench.run_to(150ms);
    const Shot& shot = bench.shots.back();
    EXPECT_NEAR(shot.frequency, row.transmitted, 1);
    EXPECT_NEAR(rad_to_deg(shot.beam_width), row.beam * 400e3 / row.transmitted, 1e-6);
    EXPECT_NEAR(rad_to_deg(shot.bearings.back()), row.widest / 2 * 255 / 256, 1e-3);
    EXPECT_NEAR(shot.pulse_length, row.longest_pulse, 1e-9);
    EXPECT_EQ(name(named(bench.sent(), "BTH0").back().bytes, 16, 4), std::string(row.model).substr(8));
}

INSTANTIATE_TEST_SUITE_P(Models, SonicSeries,
                         testing::Values(Row{"r2sonic-2020", 2, 2, 90e3, 200e3, 130, 1115e-6},
                                         Row{"r2sonic-2022", 1, 1, 650e3, 700e3, 160, 1115e-6},
                                         Row{"r2sonic-2024", 0.5, 1, 500e3, 400e3, 160, 1115e-6},
                                         Row{"r2sonic-2026", 0.5, 1, 92e3, 90e3, 160, 2000e-6},
                                         Row{"r2sonic-2026", 0.5, 1, 130e3, 100e3, 160, 2000e-6}));

TEST(R2SonicTrigger, ExternalPulsesFireTenMillisecondsLater) {
    Bench bench = head({{"trigger", std::string("external")}, {"range", 15.0}, {"sync_in", 4.0}}, with_sim);
    bench.run_to(1s);
    EXPECT_TRUE(bench.shots.empty()) << "SYI0 is off at power-up";
    bench.say(command("SYI0", std::uint32_t{1}), sim_port);
    bench.sent();
    bench.run_to(2010ms);
    // Rising edges at 1.0, 1.25, 1.5 and 1.75 s; each heard 20 ms of range and 2 ms of processing after its
    // ping.
    EXPECT_EQ(bench.shots.size(), 4u);
    const auto sent = named(bench.sent(), "BTH0");
    const double time = u32(sent.at(1).bytes, 12 + 28) + u32(sent[1].bytes, 12 + 32) * 1e-9;
    EXPECT_NEAR(std::fmod(time, 0.25), 0.010, 1e-6);
    bench.say(command("SYI0", std::uint32_t{2}), sim_port);
    bench.run_to(2500ms);
    bench.sent();
    bench.run_to(3s);
    const auto falling = named(bench.sent(), "BTH0");
    const double later = u32(falling.at(0).bytes, 12 + 28) + u32(falling[0].bytes, 12 + 32) * 1e-9;
    EXPECT_NEAR(std::fmod(later, 0.25), 0.125 + 0.010, 1e-6);
}

TEST(R2SonicMultiMode, PingsTakeTheSetsInTurn) {
    Bench bench =
        head({{"range", 15.0}, {"trigger", std::string("command")}, {"multimode_sets", std::int64_t{2}}});
    bench.say(command("FRQ1", 200e3F));
    bench.say(command("GAN2", 20.0F));
    bench.say(command("SEW2", 1.0F));
    bench.say(command("TRG0", std::uint32_t{0}));
    bench.run_to(200ms);
    ASSERT_GT(bench.shots.size(), 3u);
    for (std::size_t i = 0; i < 4; ++i) {
        const bool first = i % 2 == 0;
        EXPECT_NEAR(bench.shots[i].frequency, first ? 200e3 : 400e3, 1);
        EXPECT_NEAR(bench.shots[i].bearings.back(), (first ? 2.094395 / 2 : 0.5) * 255 / 256, 1e-5);
    }
    const auto sent = named(bench.sent(), "BTH0");
    EXPECT_FLOAT_EQ(f32(sent.at(0).bytes, 12 + 92), 13.0F);
    EXPECT_FLOAT_EQ(f32(sent.at(1).bytes, 12 + 92), 20.0F);
}

TEST(R2SonicDensity, UltraHighDensityHas1024Points) {
    Bench bench = head({{"range", 15.0}, {"intensity", true}});
    bench.say(command("UHD0", std::uint32_t{1}));
    bench.run_to(100ms);
    EXPECT_EQ(bench.shots.back().bearings.size(), 1024u);
    const Bytes b = named(bench.sent(), "BTH0").back().bytes;
    EXPECT_EQ(u16(b, 12 + 114), 1024);
    EXPECT_EQ(b.size(), 12u + 116 + (8 + 2048) + 36 + (8 + 2048) + 16 + (4 + 512));
}

TEST(R2SonicStabilisation, TurnsTheSectorAgainstTheRollAndTheFanAgainstThePitch) {
    Bench bench = head({{"range", 15.0}});
    const auto ping = [&](double roll, double pitch) {
        bench.run_to(bench.now + 10ms);
        const Ping done = *bench.ping;
        bench.ping.reset();
        auto actions = bench.device().heard(hanging(done.shot, roll, pitch), done.due);
        bench.now = done.due;
        bench.wake = *actions.wake;
        return std::pair{done.shot, named(actions.send, "BTH0").at(0).bytes};
    };
    bench.run_to(1ms);
    bench.say(command("ROS0", std::uint32_t{1}));
    bench.say(command("PTS0", std::uint32_t{1}));
    ping(0.1, 0.05);
    const auto [shot, b] = ping(0.1, 0.05);
    // Starboard is down, so the array looks to port: what lies straight below is to starboard of its axis.
    const double edge = 2.094395 / 2 * 255 / 256;
    EXPECT_NEAR(shot.bearings.front(), -edge + 0.1, 1e-5);
    EXPECT_NEAR(f32(b, 652), shot.bearings.front(), 1e-5) << "A0 first";
    EXPECT_NEAR(f32(b, 648 + 12), 0.1, 2e-3) << "roll";
    // The nose is down, so the fan lies abaft: it must be raised towards the bow, which is up in the head's
    // frame.
    EXPECT_NEAR(shot.tilt, 0.05, 2e-3);
    EXPECT_NEAR(f32(b, 12 + 68), 0.05, 2e-3) << "steering";
    bench.say(command("ROS0", std::uint32_t{0}));
    ping(0.1, 0.05);
    const auto [free, plain] = ping(0.1, 0.05);
    EXPECT_NEAR(free.bearings.front(), -edge, 1e-5);
    EXPECT_EQ(f32(plain, 648 + 12), 0.0F);
}

TEST(R2SonicAutoRange, FollowsTheBottomWhateverIsSentAgainUntilItIsSwitchedOff) {
    Bench bench = head({{"range", 40.0}, {"trigger", std::string("command")}});
    bench.echo_bin = static_cast<std::size_t>(2 * 20.0 / 1500 * 65280);  // 20 m in every beam
    bench.echo_power = 1e12F;
    const auto ranges = [&](std::initializer_list<Bytes> commands) {
        for (const Bytes& one : commands) bench.say(one);
        bench.run_to(bench.now + 1s);
        std::vector<float> told;
        for (const Send& s : named(bench.sent(), "BTH0")) told.push_back(f32(s.bytes, 12 + 88));
        return told;
    };
    const Bytes follow = command("AUT0", 0x10000u), range = command("RNG0", 40.0F);
    const auto first = ranges({follow, command("TRG0", std::uint32_t{0})});
    EXPECT_FLOAT_EQ(first.front(), 40.0F);
    EXPECT_NEAR(first.back(), 24, 0.5) << "a fifth more than the farthest point";
    for (int again = 0; again < 3; ++again)
        EXPECT_THAT(ranges({follow, range}), testing::Each(testing::FloatNear(24, 0.5F)));
    while (!bench.ping) bench.run_to(bench.now + 1ms);  // a ping of 24 m is under way
    const auto other = ranges({follow, command("RNG0", 30.0F)});
    EXPECT_THAT(other, testing::Contains(30.0F)) << "starts again from what is commanded anew";
    EXPECT_NEAR(other.back(), 24, 0.5);
    EXPECT_FLOAT_EQ(ranges({command("AUT0", 0u)}).back(), 30.0F);
}

TEST(R2SonicSim, SwitchesTheHeadOffAndOn) {
    Bench bench = head({{"range", 15.0}}, with_sim);
    bench.run_to(500ms);
    bench.say(command("RNG0", 30.0F));
    bench.say(command("SPO0", std::uint32_t{0}), sim_port);
    bench.run_to(600ms);
    bench.sent();
    bench.run_to(3s);
    const auto off = bench.sent();
    EXPECT_TRUE(named(off, "BTH0").empty());
    EXPECT_TRUE(named(off, "STH0").empty());
    EXPECT_FALSE(named(off, "STS0").empty()) << "the SIM lives on";
    bench.say(command("SPO0", std::uint32_t{1}), sim_port);
    bench.run_to(3500ms);
    const auto on = named(bench.sent(), "BTH0");
    ASSERT_FALSE(on.empty());
    EXPECT_EQ(u32(on[0].bytes, 12 + 36), 1u) << "ping numbers begin again";
    EXPECT_FLOAT_EQ(f32(on[0].bytes, 12 + 88), 15.0F) << "settings are those of power-up";
}

TEST(R2SonicSim, ACommandIsForWhomItIsSentTo) {
    Bench bench = head({{"range", 15.0}}, with_sim);
    bench.run_to(1ms);
    bench.say(command("RNG0", 30.0F), sim_port);
    bench.say(command("PTS0", 4100u), sim_port);  // there it is a port
    bench.run_to(100ms);
    EXPECT_FLOAT_EQ(f32(named(bench.sent(), "BTH0").back().bytes, 12 + 88), 15.0F);
    EXPECT_EQ(bench.shots.back().tilt, 0);
}

TEST(R2SonicQuality, TellsOfTestsUnlessTheOptionSaysOtherwise) {
    for (const auto& [word, stray, plain] :
         {std::tuple{"tests", 5u, 7u}, {"set", 7u, 7u}, {"clear", 4u, 4u}}) {
        Bench bench = head({{"range", 40.0}, {"quality_bits", std::string(word)}});
        bench.run_to(1ms);
        Echogram e = bottom_echo(bench.ping->shot, flat(15), {});
        add_pulse(e, 124, 2 * 20.0 / 1500, 40e-6, 1e9);  // one beam hears something louder behind the floor
        const auto sent = named(bench.device().heard(e, bench.ping->due).send, "BTH0");
        const Bytes& b = sent.at(0).bytes;
        const std::size_t word_of_120 = b.size() - 128 + 120 / 8 * 4;
        EXPECT_EQ(u32(b, word_of_120) >> 28, plain) << word;
        EXPECT_EQ(u32(b, word_of_120) >> (28 - 4 * 4) & 0xF, stray) << word;
    }
}

}  // namespace
}  // namespace echoloop::test
