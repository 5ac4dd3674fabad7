// What is wired to a SIM: a motion sensor, a satellite receiver and a sound velocity probe, in the words of
// their makers, and what head and SIM make of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/r2sonic_bench.h"

namespace echoloop::test {
namespace {

/// Ports behind those of the SIM, its discovery and the broadcasts: an input each.
constexpr std::size_t motion = 9, gps = 10, svp = 11;

constexpr double start = 1700000000.25;  // s, Unix
/// NovaTel's example of TSS1: roll -3.25 deg (port up +), pitch 3.19 deg (bow up +), heave -0.03 m.
const std::string tss1 = ":00FFCA -0003F-0325  0319\r\n";
/// An example of $PHOCT that is public: roll -0.106 (port up +), pitch -3.105 (bow down +), heave 0.220 (up).
const std::string phoct =
    "$PHOCT,01,192621.400,T,00,080.378,T,-000.106,T,-03.105,T,+00.220,T,+00.084,-00.025,+00.013,+00.235,"
    "+00.024,+00.078,-0008.03*09\r\n";

Bench wired(const std::string& kind, Options changes = {}) {
    const Model& model = *find_model("r2sonic-2024");
    changes.insert({{"range", 15.0}, {"trigger", std::string("command")}});
    DeviceConfig config = make_config(model, changes);
    std::vector<std::string> endpoints{"udp-listen://127.0.0.1:65500", "udp://127.0.0.1:65400",
                                       "udp-listen://127.0.0.1:65300"};
    for (const char* name : {"5001", "5002", "5003"})
        endpoints.push_back((kind == "pty" ? "pty:/tmp/echoloop/sim-" : "udp-listen://127.0.0.1:") +
                            std::string(name));
    config.endpoints = parse_endpoints(endpoints);
    config.unix_start = start;
    config.sound_speed = 1520;
    return Bench(model.make(config));
}

void say(Bench& bench, const std::string& words, std::size_t port) {
    bench.say(Bytes(words.begin(), words.end()), port);
}

/// Where the words of a status section begin.
std::size_t section_of(const Bytes& b, const std::string& section) {
    for (std::size_t at = 12; at + 4 <= b.size(); ++at)
        if (name(b, at, 4) == section) return at + 4;
    throw std::runtime_error("no section " + section);
}

/// The SIM's next status.
Bytes status(Bench& bench) {
    bench.sent();
    bench.run_to(bench.now + 1s);
    return named(bench.sent(), "STS0").at(0).bytes;
}

/// 2 bits of LED1: 0 off, 2 bad, 3 good.
std::uint32_t lamp(const Bytes& sim, int place) { return u32(sim, section_of(sim, "LED1")) >> 2 * place & 3; }
constexpr int gps_lamp = 0, motion_lamp = 1, svp_lamp = 3;

/// The BTH0 of a ping in 0.1 s, when the one before is over.
Bytes ping(Bench& bench) {
    bench.run_to(bench.now + 100ms);
    bench.say(command("PNG0", std::uint32_t{1}));
    bench.run_to(bench.now + 1ms);
    bench.sent();
    bench.hear(hanging(bench.ping->shot, 0.2, 0.1));
    return named(bench.sent(), "BTH0").at(0).bytes;
}
/// Of A0, behind H0 and R0 of 256 points.
constexpr std::size_t a0 = 12 + 116 + 520;

TEST(R2SonicInputs, AreStreamsOrDatagramsInTheOrderOfTheirEndpoints) {
    const Bench ptys = wired("pty"), datagrams = wired("udp");
    const auto streams = const_cast<Bench&>(ptys).device().ports();
    const auto ports = const_cast<Bench&>(datagrams).device().ports();
    ASSERT_EQ(streams.size(), 12u);
    ASSERT_EQ(ports.size(), 12u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(streams[motion + i].kind, Port::Kind::stream);
        EXPECT_EQ(streams[motion + i].endpoint, 3 + i) << "of the scenario";
        EXPECT_EQ(ports[motion + i].kind, Port::Kind::datagram);
        EXPECT_EQ(ports[motion + i].bind.port, 5001 + i);
    }
    EXPECT_THROW(make_device("r2sonic-2024",
                             {"udp-listen://127.0.0.1:65500", "udp://127.0.0.1:65400",
                              "udp-listen://127.0.0.1:65300", "udp://127.0.0.1:5001"},
                             {}),
                 std::invalid_argument)
        << "an input hears and does not send";
}

TEST(R2SonicInputs, TheSectorIsStabilisedAgainstTheMotionSensorAndNotTheTruth) {
    Bench bench = wired("udp");
    bench.say(command("ROS0", std::uint32_t{1}));
    bench.say(command("PTS0", std::uint32_t{1}));
    bench.run_to(10ms);
    ping(bench);  // hangs with its port side 0.2 rad up
    bench.run_to(400ms);
    Bytes bth0 = ping(bench);
    EXPECT_EQ(name(bth0, a0, 2), "A0");
    EXPECT_EQ(f32(bth0, a0 + 12), 0.0F) << "nobody has said how it rolls";
    const double level = f32(bth0, a0 + 4);
    bench.run_to(800ms);
    say(bench, tss1, motion);
    bth0 = ping(bench);
    EXPECT_NEAR(f32(bth0, a0 + 12), deg_to_rad(-3.25), 1e-6) << "roll";
    EXPECT_NEAR(f32(bth0, a0 + 4) - level, deg_to_rad(-3.25), 2e-4) << "first angle";
    EXPECT_NEAR(f32(bth0, 12 + 68), deg_to_rad(-3.19), 1e-4) << "steered against the bow, which is up";
    bench.run_to(3s);
    EXPECT_EQ(f32(ping(bench), a0 + 12), 0.0F) << "it has been silent for more than a second";
}

TEST(R2SonicInputs, TheStatusTellsWhatTheMotionSensorSays) {
    Bench bench = wired("pty");
    bench.run_to(500ms);
    say(bench, tss1.substr(0, 11), motion);
    say(bench, tss1.substr(11), motion);  // in pieces
    const Bytes sim = status(bench);
    const std::size_t at = section_of(sim, "SEN7");
    EXPECT_NEAR(f32(sim, at + 8), deg_to_rad(-3.19), 1e-6) << "pitch, bow down +";
    EXPECT_NEAR(f32(sim, at + 12), deg_to_rad(-3.25), 1e-6) << "roll";
    EXPECT_NEAR(f32(sim, at + 16), -0.03, 1e-6) << "heave";
    bench.run_to(1500ms);
    say(bench, phoct, motion);
    const Bytes second = status(bench);
    EXPECT_NEAR(f32(second, at + 8), deg_to_rad(-3.105), 1e-6) << "pitch, bow down +";
    EXPECT_NEAR(f32(second, at + 12), deg_to_rad(-0.106), 1e-6);
    EXPECT_NEAR(f32(second, at + 16), 0.220, 1e-6);
}

TEST(R2SonicInputs, TheClockStandsIn1970UntilAZdaComes) {
    Bench bench = wired("udp");
    bench.run_to(100ms);
    EXPECT_EQ(u32(ping(bench), 12 + 28), 0u) << "Unix seconds of H0";
    bench.run_to(900ms);  // 0.15 s behind the pulse of 1700000001
    say(bench, "$GPGGA,221321.00,,,,,0,,,,,,,,*49\r\n$GPZDA,221321.00,14,11,2023,00,00*61\r\n", gps);
    Bytes bth0 = ping(bench);
    EXPECT_EQ(u32(bth0, 12 + 28), 1700000001u);
    EXPECT_NEAR(u32(bth0, 12 + 32) * 1e-9, 0.25, 2e-3) << "by the pulse, not by when the sentence came";
    bench.run_to(1900ms);
    say(bench, "$GPZDA,221330.00,14,11,2023,00,00*61\r\n", gps);  // nine seconds ahead
    bth0 = ping(bench);
    EXPECT_EQ(u32(bth0, 12 + 28), 1700000010u) << "a receiver that is wrong makes wrong times";
}

TEST(R2SonicInputs, ATrimblesTimeIsThatOfTheNextPulseAndGoesBeforeZda) {
    Bench bench = wired("udp");
    bench.run_to(200ms);  // 0.55 s before the pulse of 1700000001
    say(bench, "UTC 23.11.14 22:13:21 57\r\n", gps);
    Bytes bth0 = ping(bench);
    EXPECT_EQ(u32(bth0, 12 + 28), 1700000000u);
    EXPECT_NEAR(u32(bth0, 12 + 32) * 1e-9, 0.55, 2e-3);
    say(bench, "$GPZDA,221330.00,14,11,2023,00,00*61\r\n", gps);
    EXPECT_EQ(u32(ping(bench), 12 + 28), 1700000000u);
    EXPECT_EQ(bench.device().counters().rejected, 0u);
}

TEST(R2SonicInputs, TheProbesSoundSpeedIsTheHeads) {
    Bench bench = wired("udp");
    const auto speed = [&] { return f32(ping(bench), 12 + 44); };
    bench.run_to(100ms);
    EXPECT_EQ(speed(), 1500.0F) << "SVL0, while no probe speaks";
    const std::pair<const char*, float> words[]{
        {" 1491.250\r\n", 1491.25F},  // miniSVS
        {" 1492.50\r\n", 1492.5F},    // SmartSV
        {"  12.0000, 3.50000,  35.0000, 1493.500\r\n", 1493.5F},
        {"  12.0000, 3.50000,   10.000,  35.0000, 1494.500\r\n", 1494.5F},
        {"1495500100123450000\r\n", 1495.5F}};
    for (const auto& [word, expected] : words) {
        say(bench, word, svp);
        EXPECT_EQ(speed(), expected) << word;
    }
    EXPECT_EQ(bench.device().counters().rejected, 0u);
    bench.say(command("SVL0", 1510.0F));
    bench.say(command("SVU0", std::uint32_t{1}));
    EXPECT_EQ(speed(), 1510.0F) << "commanded";
}

TEST(R2SonicInputs, WhatIsMalformedIsCountedAndChangesNothing) {
    Bench bench = wired("udp");
    bench.say(command("ROS0", std::uint32_t{1}));
    bench.run_to(200ms);
    say(bench, tss1, motion);
    const std::uint64_t understood = bench.device().counters().messages;
    const std::pair<const char*, std::size_t> damaged[]{
        {":00FFCA -0003F-03X5  0319\r\n", motion},
        {"$PHOCT,01,192621.400,T,00,080.378,T,-000.106,E,-03.105,T,+00.220,T,0,0,0,0,0,0,0\r\n", motion},
        {"$GPZDA,221321.00,14,11,2023,00,00*6D\r\n", gps},
        {"$GPZDA,221321.00,31,02,2023,00,00\r\n", gps},
        {"UTC 23.13.14 22:13:21 57\r\n", gps},
        {" 149.250\r\n", svp},
        {"1491,1492\r\n", svp}};
    for (const auto& [words, port] : damaged) say(bench, words, port);
    say(bench, "$HEHDT,30.40,T\r\n", gps);  // it has no use for that one
    const DeviceCounters counters = bench.device().counters();
    EXPECT_EQ(counters.rejected, std::size(damaged));
    EXPECT_EQ(counters.messages, understood + 1);
    say(bench, tss1.substr(0, 20), motion);
    EXPECT_EQ(bench.device().counters().skipped_bytes, 20u) << "no line goes over two datagrams";
    const Bytes bth0 = ping(bench);
    EXPECT_NEAR(f32(bth0, a0 + 12), deg_to_rad(-3.25), 1e-6);
    EXPECT_EQ(u32(bth0, 12 + 28), 0u);
    EXPECT_EQ(f32(bth0, 12 + 44), 1500.0F);
}

TEST(R2SonicInputs, LampsAreGoodBadOrOff) {
    Bench bench = wired("udp");
    bench.run_to(500ms);
    say(bench, tss1, motion);
    Bytes sim = status(bench);
    EXPECT_EQ(lamp(sim, motion_lamp), 3u);
    EXPECT_EQ(lamp(sim, gps_lamp), 2u) << "nothing has come";
    EXPECT_EQ(lamp(sim, svp_lamp), 2u);
    bench.say(command("ENM0", std::uint32_t{0}), sim_port);
    bench.say(command("ENS0", std::uint32_t{0}), sim_port);
    say(bench, tss1, motion);
    say(bench, " 1491.250\r\n", svp);
    sim = status(bench);
    EXPECT_EQ(lamp(sim, motion_lamp), 0u) << "switched off";
    EXPECT_EQ(f32(sim, section_of(sim, "SEN7") + 12), 0.0F) << "so there is no roll";
    EXPECT_EQ(lamp(sim, svp_lamp), 0u);
    bench.say(command("ENM0", std::uint32_t{1}), sim_port);
    bench.say(command("PTM0", std::uint32_t{5009}), sim_port);
    say(bench, tss1, motion);
    EXPECT_EQ(lamp(status(bench), motion_lamp), 2u) << "it listens at another port";
    bench.say(command("PTM0", std::uint32_t{5001}), sim_port);
    bench.run_to(bench.now + 500ms);
    say(bench, tss1, motion);
    EXPECT_EQ(lamp(status(bench), motion_lamp), 3u);
}

TEST(R2SonicInputs, ALineAtAnotherBaudIsGarbage) {
    Bench bench = wired("pty");
    bench.run_to(500ms);
    bench.say(command("BDM0", std::uint32_t{115200}), sim_port);
    bench.device().line_rate(motion, 9600);
    const std::uint64_t before = bench.device().counters().skipped_bytes;
    say(bench, tss1, motion);
    EXPECT_EQ(bench.device().counters().skipped_bytes, before + tss1.size());
    EXPECT_EQ(lamp(status(bench), motion_lamp), 2u);
    bench.device().line_rate(motion, 115200);
    bench.run_to(bench.now + 500ms);
    say(bench, tss1, motion);
    EXPECT_EQ(lamp(status(bench), motion_lamp), 3u);
}

}  // namespace
}  // namespace echoloop::test
