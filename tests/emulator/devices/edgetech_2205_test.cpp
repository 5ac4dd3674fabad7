// An EdgeTech 2205 on a bench: what it says is read by the offsets of the specification, not by the project's
// codec.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/emulator/devices/noisy_line.h"

namespace echoloop::test {
namespace {
using namespace std::chrono_literals;

enum Ports : std::size_t { commands, data };

std::uint64_t number_at(const Bytes& b, std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8 | b.at(at + i);
    return value;
}

std::string little(std::uint32_t value, int bytes) {
    Bytes out;
    for (int i = 0; i < bytes; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    return to_hex(out);
}

constexpr unsigned low = 20, high = 21;
enum { set, get };

/// A message of a host.
std::string say(unsigned type, int command, unsigned subsystem, unsigned channel, const std::string& body) {
    return "01160d00" + little(type, 2) + little(static_cast<unsigned>(command), 1) + little(subsystem, 1) +
           little(channel, 1) + "000000" + little(static_cast<unsigned>(body.size() / 2), 4) + body;
}
std::string set_to(unsigned type, unsigned subsystem, std::uint32_t value, unsigned channel = 0) {
    return say(type, set, subsystem, channel, little(value, 4));
}

/// What is sent on one port.
std::vector<Bytes> sent_on(Bench& bench, std::size_t port) {
    std::vector<Bytes> out;
    for (const Send& send : bench.sent())
        if (send.port == port) out.push_back(send.bytes);
    return out;
}

std::vector<Bytes> answers(Bench& bench, const std::string& hex) {
    bench.sent();
    bench.say(hex, commands);
    return sent_on(bench, commands);
}

void switch_on(Bench& bench, unsigned subsystem, std::uint32_t range = 50000) {
    for (const unsigned channel : {0U, 1U}) bench.say(set_to(83, subsystem, 1, channel), commands);
    bench.say(set_to(128, subsystem, range), commands);
    bench.say(set_to(120, subsystem, 1), commands);
}

/// One side of one ping.
struct Side {
    unsigned subsystem, channel;
    std::uint64_t ping;
    std::vector<double> volts;
    double metres_per_sample;
    Bytes bytes;
};
Side side_of(const Bytes& b) {
    const std::size_t head = 16;
    EXPECT_EQ(number_at(b, 0, 2), 0x1601U);
    EXPECT_EQ(number_at(b, 4, 2), 80U);
    EXPECT_EQ(number_at(b, 12, 4), b.size() - head);
    Side side{b[7], b[8], number_at(b, head + 8, 4), {}, 0, b};
    EXPECT_EQ(number_at(b, head + 34, 2), 0U) << "envelope";
    const auto bits = static_cast<int>(number_at(b, head + 168, 2));
    const auto count = static_cast<std::size_t>(number_at(b, head + 114, 2));
    EXPECT_EQ(b.size(), head + 240 + 2 * count);
    for (std::size_t i = 0; i < count; ++i)
        side.volts.push_back(std::ldexp(static_cast<double>(number_at(b, head + 240 + 2 * i, 2)), -bits));
    side.metres_per_sample = 750e-9 * static_cast<double>(number_at(b, head + 116, 4));
    return side;
}

/// Both sides of a ping with one echo on one of them.
std::vector<Side> sides(float power, std::size_t bin, std::size_t beam, const Options& changes = {}) {
    Bench bench(make_device("edgetech-2205", {}, changes));
    switch_on(bench, high);
    bench.run_to(1ms);
    EXPECT_TRUE(bench.ping);
    Echogram echogram = echo_of(bench.ping->shot, 0, 0);
    echogram.values.at(beam * echogram.shot.bins + bin) = power;
    bench.hear(echogram);
    std::vector<Side> out;
    for (const Bytes& message : sent_on(bench, data)) out.push_back(side_of(message));
    return out;
}

TEST(Edgetech2205, IsSilentUntilAHostSwitchesItOn) {
    Bench bench(make_device("edgetech-2205"));
    bench.run_to(1s);
    EXPECT_FALSE(bench.ping);
    switch_on(bench, high);
    bench.run_to(bench.now);
    ASSERT_TRUE(bench.ping);
    bench.say(set_to(120, high, 0), commands);
    bench.run_to(3s);
    EXPECT_EQ(bench.shots.size(), 1U) << "the ping under way is finished, no other follows";
}

TEST(Edgetech2205, SetsAreNotAnsweredAndGetsAre) {
    Bench bench(make_device("edgetech-2205"));
    EXPECT_TRUE(answers(bench, "01160d008000001500000000 04000000 50c30000").empty());
    const auto said = answers(bench, "01160d008000011500000000 00000000");
    ASSERT_EQ(said.size(), 1U);
    EXPECT_EQ(to_hex(said[0]), "01160d0080000215000000000400000050c30000");
    // What a known host leaves in a get is ignored.
    EXPECT_EQ(answers(bench, "01160d008000011500000000 04000000 01020304"), said);
    Bench replying(make_device("edgetech-2205", {}, {{"sets", std::string("reply")}}));
    EXPECT_EQ(answers(replying, "01160d008000001500000000 04000000 50c30000"), said);
}

TEST(Edgetech2205, TellsItsTime) {
    DeviceConfig config = make_config(*find_model("edgetech-2205"));
    config.unix_start = 1700000000;
    Bench bench(find_model("edgetech-2205")->make(config));
    bench.run_to(250ms);
    const auto said = answers(bench, "01160d001600010000000000 00000000");
    ASSERT_EQ(said.size(), 1U);
    EXPECT_EQ(to_hex(said[0]), "01160d0016000200000000000800000000f15365fab4c404");
}

TEST(Edgetech2205, RangesAreKeptWithinBounds) {
    Bench bench(make_device("edgetech-2205"));
    const auto range = [&](unsigned subsystem, std::uint32_t asked) {
        bench.say(set_to(128, subsystem, asked), commands);
        return number_at(answers(bench, say(128, get, subsystem, 0, "")).at(0), 16, 4);
    };
    EXPECT_EQ(range(high, 100000), 75000U);
    EXPECT_EQ(range(high, 0), 5000U);
    EXPECT_EQ(range(low, 100000), 100000U);
    EXPECT_EQ(range(low, 4000000000U), 150000U);
}

TEST(Edgetech2205, WhatItDoesNotKnowIsAnError) {
    Bench bench(make_device("edgetech-2205"));
    for (const std::string& wrong :
         {set_to(999, high, 1), set_to(128, 22, 1), set_to(83, high, 1, 2), say(128, set, high, 0, ""),
          say(129, set, low, 0, little(20, 4) + little(1, 4) + little(0, 4)),
          say(129, set, low, 0, little(21, 4) + little(0, 4) + little(0, 4)), say(80, get, high, 0, "")}) {
        const auto said = answers(bench, wrong);
        ASSERT_EQ(said.size(), 1U) << wrong;
        EXPECT_EQ(said[0][6], 3) << wrong;
        EXPECT_EQ(said[0].size(), 16U) << wrong;
        EXPECT_EQ(number_at(said[0], 4, 2), number_at(from_hex(wrong), 4, 2));
    }
}

TEST(Edgetech2205, DataHaveTheHeaderOfTheSpecification) {
    DeviceConfig config = make_config(*find_model("edgetech-2205"), {{"samples", std::int64_t{1000}}});
    config.unix_start = 1700000000.25;
    config.origin = GeoPlace{59.4, 10.5, 0};
    Bench bench(find_model("edgetech-2205")->make(config));
    // Bow to the east, 1 deg down, 2 deg rolled to starboard, 5 m deep, at 2 m/s.
    bench.where = [](Time time) {
        const Quat roll = axis_angle({1, 0, 0}, deg_to_rad(2)), pitch = axis_angle({0, 1, 0}, deg_to_rad(1));
        return Located{time, {{0, 0, -5}, pitch * roll}, {{2, 0, 0}, {}}};
    };
    switch_on(bench, high);
    bench.run_to(1ms);
    bench.echo_bin = 10, bench.echo_power = 1e12F;
    bench.hear();
    const auto messages = sent_on(bench, data);
    ASSERT_EQ(messages.size(), 2U);
    const Bytes& b = messages[1];
    const auto field = [&](std::size_t at, std::size_t size) {
        return to_hex(ByteView(b).subspan(16 + at, size));
    };
    EXPECT_EQ(to_hex(ByteView(b).first(16)),
              "01160d00500000150100"
              "0000"
              "c0080000");
    EXPECT_EQ(field(0, 4), "00f15365");
    EXPECT_EQ(field(8, 4), "01000000");
    EXPECT_EQ(field(28, 2), "0100");
    EXPECT_EQ(field(30, 2), "2f42") << "position, course, speed, heading, pitch and roll, depth, sound speed";
    EXPECT_EQ(field(80, 10), "60216000c0d21f020200");
    EXPECT_EQ(field(114, 10), "e8036a04010000006400");
    EXPECT_EQ(field(126, 4), to_hex(from_hex("5898 f8a7"))) << "390 and 430 kHz";
    EXPECT_EQ(field(136, 4), "88130000");
    EXPECT_EQ(field(140, 2), "983a");
    EXPECT_EQ(field(148, 4), "0080bb44");
    EXPECT_EQ(field(156, 12), "e7073e0116000d0014000300");
    EXPECT_EQ(field(172, 6), "28234aff6c01") << "roll with port up";
    EXPECT_EQ(field(192, 4), "5a002700") << "90 deg, 3.9 kn";
    EXPECT_EQ(field(200, 4), "fab4c404");
    EXPECT_EQ(field(220, 2), "0100");
}

TEST(Edgetech2205, RangeIsThatOfTheEcho) {
    const auto said = sides(1e12F, 500, 0);
    ASSERT_EQ(said.size(), 2U);
    const auto& volts = said[0].volts;
    const auto at = std::max_element(volts.begin(), volts.end()) - volts.begin();
    EXPECT_EQ(at, 500);
    EXPECT_NEAR(said[0].metres_per_sample * static_cast<double>(volts.size()), 50, 0.01);
}

TEST(Edgetech2205, LevelsFollowTheSonarEquation) {
    const auto peak = [](float power) { return std::ranges::max(sides(power, 500, 0).at(0).volts); };
    EXPECT_NEAR(20 * std::log10(peak(1e14F) / peak(1e10F)), 40, 0.01) << "whatever the weighting";
    EXPECT_NEAR(peak(static_cast<float>(std::pow(10, 20.4))), 10, 0.01) << "full scale where the input clips";
}

TEST(Edgetech2205, PortIsNotStarboard) {
    for (const std::size_t side : {0U, 1U}) {
        const auto said = sides(1e12F, 700, side);
        ASSERT_EQ(said.size(), 2U);
        EXPECT_EQ(said[0].channel, 0U);
        EXPECT_EQ(said[1].channel, 1U);
        EXPECT_EQ(said[0].ping, said[1].ping) << "a reader pairs them by it";
        EXPECT_GT(said[side].volts[700], 0);
        EXPECT_EQ(said[1 - side].volts[700], 0);
    }
    const Shot shot =
        find_model("edgetech-2205")->default_shot(make_config(*find_model("edgetech-2205")), 0, 0);
    EXPECT_THAT(shot.bearings, testing::ElementsAre(-std::numbers::pi / 2, std::numbers::pi / 2));
}

TEST(Edgetech2205, SidesHaveDepressionAndLevelOfTheirOwn) {
    DeviceConfig config = make_config(*find_model("edgetech-2205"));
    config.profile.at("starboard_depression").value = 35.0;
    config.profile.at("starboard_trim").value = -3.0;
    const Shot shot = find_model("edgetech-2205")->default_shot(config, 0, 0);
    ASSERT_EQ(shot.sides.size(), 2U);
    EXPECT_NEAR(shot.sides[0].depression, deg_to_rad(20), 1e-9);
    EXPECT_NEAR(shot.sides[1].depression, deg_to_rad(35), 1e-9);
    EXPECT_NEAR(shot.sides[0].source_level - shot.sides[1].source_level, 3, 1e-9);
}

TEST(Edgetech2205, OnlySidesThatAreWantedAreSent) {
    Bench bench(make_device("edgetech-2205"));
    bench.say(set_to(83, high, 1, 1), commands);
    bench.say(set_to(120, high, 1), commands);
    bench.run_to(100ms);
    const auto messages = sent_on(bench, data);
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_EQ(messages[0][8], 1);
}

/// The weighting follows the strongest echo, but does not flicker from ping to ping.
TEST(Edgetech2205, WeightingStaysWhereItCan) {
    Bench bench(make_device("edgetech-2205"));
    switch_on(bench, high);
    std::vector<std::uint64_t> bits;
    for (const float power : {1e12F, 3e12F, 0.6e12F, 1e15F, 1e15F, 1e12F}) {
        while (!bench.ping) bench.run_to(bench.now + 1ms);
        bench.hear(echo_of(bench.ping->shot, 300, power));
        bits.push_back(number_at(sent_on(bench, data).at(0), 16 + 168, 2));
    }
    EXPECT_EQ(bits[1], bits[0] - 1) << "21000 counts and three times the power are too many";
    EXPECT_EQ(bits[2], bits[1]);
    EXPECT_EQ(bits[3], bits[4]);
    EXPECT_LT(bits[3], bits[2]);
    EXPECT_GT(bits[5], bits[4]) << "30 dB less is much room";
}

TEST(Edgetech2205, PingsWithTheRangesPeriod) {
    Bench bench(make_device("edgetech-2205"));
    switch_on(bench, high, 30000);
    bench.run_to(1s);
    EXPECT_NEAR(static_cast<double>(bench.shots.size()), 1 / (0.04 + 0.005), 1);
}

TEST(Edgetech2205, TwoSubsystemsPingInTurnAndACoupledOneWithEachNth) {
    Bench bench(make_device("edgetech-2205"));
    switch_on(bench, high, 20000);
    switch_on(bench, low, 20000);
    bench.run_to(1s);
    bench.shots.clear();
    bench.run_to(2s);
    const auto lows = std::ranges::count(bench.shots, 120e3, &Shot::frequency);
    EXPECT_NEAR(static_cast<double>(lows), static_cast<double>(bench.shots.size()) / 2, 1);

    bench.say(set_to(125, low, 2), commands);
    bench.say(say(129, set, low, 0, little(high, 4) + little(3, 4) + little(0, 4)), commands);
    bench.run_to(3s);
    bench.shots.clear();
    bench.sent();
    bench.run_to(5s);
    const auto coupled = static_cast<double>(std::ranges::count(bench.shots, 120e3, &Shot::frequency));
    EXPECT_NEAR(coupled, static_cast<double>(bench.shots.size()) / 4, 1);
    for (const Bytes& message : sent_on(bench, data)) EXPECT_TRUE(message[7] == low || message[7] == high);
    bench.say(set_to(120, high, 0), commands);
    bench.run_to(6s);
    bench.shots.clear();
    bench.run_to(7s);
    EXPECT_TRUE(bench.shots.empty()) << "nothing to be coupled to";
}

TEST(Edgetech2205, AShutdownHangsUpAndWaitsForTheNextHost) {
    Bench bench(make_device("edgetech-2205"));
    switch_on(bench, high);
    bench.run_to(10ms);
    bench.say(set_to(25, 0, 1), commands);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 2U);
    EXPECT_TRUE(sent[0].hang_up && sent[1].hang_up);
    bench.ping.reset();
    bench.run_to(1s);
    EXPECT_FALSE(bench.ping);
    switch_on(bench, high);
    bench.run_to(2s);
    EXPECT_FALSE(sent_on(bench, data).empty());

    Bench off(make_device("edgetech-2205", {}, {{"shutdown", std::string("off")}}));
    off.say(set_to(25, 0, 1), commands);
    EXPECT_TRUE(answers(off, say(22, get, 0, 0, "")).empty());
}

TEST(Edgetech2205, NoNoiseOnTheLineWedgesIt) {
    Bench bench(make_device("edgetech-2205"));
    NoisyHost host;
    host.words = {set_to(83, high, 1),
                  set_to(128, high, 20000),
                  set_to(120, high, 1),
                  set_to(125, low, 2),
                  say(129, set, low, 0, little(high, 4) + little(1, 4) + little(0, 4)),
                  say(22, get, 0, 0, "")};
    // A damaged size may ask for the next 128 bytes: they come, and are lost.
    for (int i = 0; i < 8; ++i) host.request += set_to(141, high, 0);
    host.request += say(128, get, low, 0, "");
    host.is_answer = [](const Send& send) {
        return send.port == commands && send.bytes.size() == 20 && send.bytes[4] == 128 &&
               send.bytes[7] == low;
    };
    expect_no_wedge(bench, host, 300);
}

TEST(Edgetech2205, EveryFigureHasASource) {
    const Model& model = *find_model("edgetech-2205");
    std::string without;
    for (const auto& [name, figure] : own_profile(model))
        if (figure.source.starts_with("TODO")) without += name + ' ';
    EXPECT_EQ(without, "");
}

}  // namespace
}  // namespace echoloop::test
