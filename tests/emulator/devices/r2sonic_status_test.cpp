// What a Sonic and its SIM tell of themselves by and by, by the offsets of the R2Sonic notes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/r2sonic_bench.h"

namespace echoloop::test {
namespace {

TEST(R2SonicStatus, OnceASecondAndTheBriefOneEvery1300MillisecondsToBasePlusTwo) {
    Bench bench = head({{"trigger", std::string("command")}});
    bench.run_to(2500ms);
    const auto sent = bench.sent();
    const auto brief = named(sent, "R2DS");
    const auto full = named(sent, "STH0");
    ASSERT_EQ(brief.size(), 2u) << "every 1.3 s";
    EXPECT_EQ(full.size(), 3u) << "once a second";
    EXPECT_EQ(brief[0].to.port, gui.port + 2);
    EXPECT_EQ(brief[0].bytes.size(), 24u);
    EXPECT_EQ(name(brief[0].bytes, 4, 6), "100017");
    bench.run_to(2599ms);
    EXPECT_TRUE(bench.sent().empty());
    bench.say(command("STM0", std::uint32_t{0}));
    bench.run_to(5s);
    const auto quiet = bench.sent();
    EXPECT_TRUE(named(quiet, "STH0").empty());
    EXPECT_EQ(named(quiet, "R2DS").size(), 2u) << "at 2.6 and 3.9 s";
}

/// Where the words of a status section begin; the fourth character of a name is their number in base 36.
std::size_t words_of(const Bytes& b, const std::string& section) {
    for (std::size_t at = 12; at + 4 <= b.size();) {
        if (name(b, at, 4) == section) return at + 4;
        const std::uint8_t count = b[at + 3];
        at += 4 + 4 * static_cast<std::size_t>(count <= '9' ? count - '0' : (count | 0x20) - 'a' + 10);
    }
    throw std::runtime_error("no section " + section);
}

/// A head at a known time in warm water, with a SIM and, if `sync` is not 0, pulses at its sync input.
Bench watched_head(double sync) {
    const Model& model = *find_model("r2sonic-2024");
    DeviceConfig config =
        make_config(model, {{"range", 15.0}, {"trigger", std::string("command")}, {"sync_in", sync}});
    config.endpoints = {parse_endpoint("udp-listen://127.0.0.1:65500"),
                        parse_endpoint("udp://127.0.0.1:65400"),
                        parse_endpoint("udp-listen://127.0.0.1:65300")};
    config.unix_start = 1700000000.25;
    config.sound_speed = 1520;
    return Bench(model.make(config));
}

constexpr std::uint32_t gps_seconds = 1700000000 - 315964800 + 18;  // since 6 January 1980, with leap seconds

TEST(R2SonicStatus, TellsTimeAttitudeAndDepth) {
    Bench bench = watched_head(0);
    bench.run_to(1ms);
    bench.say(command("PNG0", std::uint32_t{1}));
    bench.run_to(2ms);
    const Ping done = *std::exchange(bench.ping, {});
    Echogram echo = hanging(done.shot, 0.1, 0.05);
    echo.sound_speed = 1520;  // of the water at the head
    bench.device().heard(echo, done.due);
    bench.sent();
    bench.run_to(1s);
    const Bytes head_says = named(bench.sent(), "STH0").at(0).bytes;
    bench.run_to(2s);
    const Bytes sim_says = named(bench.sent(), "STS0").at(0).bytes;
    const std::size_t head_sensors = words_of(head_says, "SENa"), sim_sensors = words_of(sim_says, "SEN7");
    EXPECT_EQ(u32(head_says, head_sensors), gps_seconds + 1);
    EXPECT_EQ(u32(head_says, head_sensors + 4), 0x40000000u) << "a quarter of a second";
    EXPECT_EQ(u32(sim_says, sim_sensors), gps_seconds + 2);
    EXPECT_EQ(u32(sim_says, sim_sensors + 4), 0x40000000u);
    for (const auto& [b, at] : {std::pair{head_says, head_sensors}, {sim_says, sim_sensors}}) {
        EXPECT_NEAR(f32(b, at + 8), 0.05, 1e-3) << "pitch, as the fan is stabilised against";
        EXPECT_NEAR(f32(b, at + 12), 0.1, 1e-3) << "roll";
        EXPECT_EQ(f32(b, at + 16), 0.0F) << "heave";
        EXPECT_EQ(f32(b, at + 24), 1520.0F) << "sound speed";
    }
    EXPECT_NEAR(f32(head_says, head_sensors + 28), 7, 1e-5) << "depth uncalibrated";
    EXPECT_NEAR(f32(head_says, head_sensors + 32), 7, 1e-5) << "depth";
}

TEST(R2SonicStatus, TellsItsPartsOptionsAndDatagrams) {
    Bench bench = watched_head(0);
    bench.run_to(1ms);
    bench.say(command("PNG0", std::uint32_t{1}));
    bench.say(Bytes{1, 2, 3});
    bench.run_to(999ms);
    const auto before = bench.sent();
    bench.run_to(1s);
    const Bytes b = named(bench.sent(), "STH0").at(0).bytes;
    EXPECT_EQ(b.size(), u32(b, 4));
    EXPECT_EQ(name(b, words_of(b, "SER3"), 6), "100017");
    EXPECT_EQ(name(b, words_of(b, "MDL3"), 4), "2024");
    EXPECT_EQ(u32(b, words_of(b, "OPT1")), 0x1Du) << "TruePix, forward looking, water column, 700 kHz";
    const std::size_t ethernet = words_of(b, "ETH6");
    EXPECT_EQ(u32(b, ethernet), 1000u) << "Mbit/s";
    EXPECT_EQ(u32(b, ethernet + 4), 2u) << "received";
    EXPECT_GT(before.size(), 4u) << "two of each part and a ping";
    EXPECT_EQ(u32(b, ethernet + 8), before.size()) << "sent";
    EXPECT_EQ(u32(b, ethernet + 12), 0u) << "overflows";
}

TEST(R2SonicStatus, LampsOfTheSimTellOfSyncPulsesAndOfTheHeadsPower) {
    for (const bool pulses : {true, false}) {
        Bench bench = watched_head(pulses ? 4 : 0);
        const auto lamps = [&] {
            bench.sent();
            bench.run_to(bench.now + 1s);
            const Bytes b = named(bench.sent(), "STS0").at(0).bytes;
            return u32(b, words_of(b, "LED1"));
        };
        constexpr std::uint32_t good = 3, gps = 0, motion = 2, sound_speed = 6, pps = 16, sync = 18,
                                power = 22;
        const std::uint32_t sensors = good << gps | good << motion | good << sound_speed | good << pps;
        const std::uint32_t synced = pulses ? good << sync : 0;
        EXPECT_EQ(lamps(), sensors | synced | good << power);
        bench.say(command("SPO0", std::uint32_t{0}), sim_port);
        EXPECT_EQ(lamps(), sensors | synced) << "the head is off";
    }
}

}  // namespace
}  // namespace echoloop::test
