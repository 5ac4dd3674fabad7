// The 852 echo sounder on the bench: its replies, its profile range, its external trigger.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/emulator/devices/imagenex_bench.h"
#include "tests/emulator/devices/noisy_line.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;

// id 11, 10 m, 12 dB, 0.2 dB/m, 100 us, 500 points, everything else 0
const std::string plain = "FE44110A0000430 00C0014 000000 64 00 0000 00 32 00 00 00 00 00 00 FD";
enum At {
    id = 2,
    range,
    mode = 6,
    gain = 8,
    logf,
    absorption,
    pulse = 14,
    least,
    trigger = 18,
    points,
    bits,
    baud,
    profile,
    delay = 24
};

Bytes command(const Changes& changes = {}) { return changed(plain, changes); }
/// Its replies come as a whole when their last byte would, unless `changes` says otherwise.
Bench sounder(Options changes = {}) {
    changes.try_emplace("baud", 0.0);
    return Bench(make_device("imagenex-852", {}, changes));
}

TEST(Imagenex852, AnswersAsTheRecordedOneDid) {
    Bench bench = sounder();
    bench.echo_bin = 224;  // of 500 samples of 2 cm
    bench.echo_power = 1e15F;
    const Bytes reply = ask(bench, command());
    ASSERT_EQ(reply.size(), 513u);
    EXPECT_EQ(to_hex(ByteView(reply).first(12)), "4947581145780a0a40037403");  // 448 cm
    EXPECT_EQ(reply.at(12 + 224), 127);
    EXPECT_EQ(reply.back(), 0xFC);
    const Shot& shot = bench.shots.at(0);
    EXPECT_EQ(shot.pan, 0);
    EXPECT_DOUBLE_EQ(shot.frequency, 675e3);
    EXPECT_DOUBLE_EQ(shot.pulse_length, 100e-6) << "1 us units";
    EXPECT_NEAR(shot.bin_interval * static_cast<double>(shot.bins), 2 * 10 / 1500.0, 1e-12);
}

TEST(Imagenex852, ThreeRepliesAndTheOptionsOfItsHeader) {
    Bench bench = sounder({{"position_bytes", std::string("00 00")}, {"status", std::string("41")}});
    EXPECT_EQ(to_hex(ByteView(ask(bench, command({{points, 25}}))).first(8)), "494d58114100000a");
    EXPECT_EQ(ask(bench, command({{points, 25}})).size(), 265u);
    EXPECT_EQ(ask(bench, command({{profile, 1}})).size(), 13u);
    EXPECT_TRUE(ask(bench, command({{id, 0x10}})).empty());
    Bench other = sounder({{"head_id", std::int64_t{0x15}}});
    EXPECT_EQ(ask(other, command({{id, 0x15}})).at(3), 0x15);
}

TEST(Imagenex852, AModeByteOfZeroIsAnsweredUnlessItIsStrict) {
    Bench bench = sounder(), strict = sounder({{"mode_byte", std::string("strict")}});
    EXPECT_EQ(ask(bench, command({{mode, 0}})).size(), 513u);
    EXPECT_TRUE(ask(strict, command({{mode, 0}})).empty());
    EXPECT_EQ(ask(strict, command()).size(), 513u);
}

TEST(Imagenex852, ProfileRangeIsInStepsOfTwoCentimetresWhateverThePoints) {
    Bench bench = sounder();
    bench.echo_power = 1e15F;
    bench.echo_bin = 415;  // of 2500 samples of 2 cm over 50 m
    EXPECT_EQ(u14(ask(bench, command({{range, 50}})), 8), 830);
    EXPECT_EQ(bench.shots.back().bins, 2500u);
    bench.echo_bin = 123;  // of 500 samples of 1 cm over 5 m
    EXPECT_EQ(u14(ask(bench, command({{range, 5}})), 8), 124);
    EXPECT_EQ(u14(ask(bench, command({{range, 5}, {least, 20}})), 8), 0) << "the host blanks 2 m";
    bench.echo_bin = 20;
    EXPECT_EQ(u14(ask(bench, command({{range, 5}})), 8), 0) << "nearer than half a metre";
}

TEST(Imagenex852, GainIsTheHostsAndLogfStaysTen) {
    Bench bench = sounder();
    bench.echo_bin = 400;
    const double level = 130 - 12 - 10 * std::log10(8.01) - 0.4 * 8.01 - 6.02;  // half of the scale at 8.01 m
    bench.echo_power = static_cast<float>(std::pow(10.0, level / 10));
    EXPECT_NEAR(ask(bench, command()).at(12 + 400), 64, 1);
    EXPECT_NEAR(ask(bench, command({{gain, 6}})).at(12 + 400), 32, 1);
    EXPECT_NEAR(ask(bench, command({{logf, 3}})).at(12 + 400), 64, 1);
}

TEST(Imagenex852, AShotTakesTheEchoTheWorkAndTheLine) {
    Bench bench = sounder();
    ask(bench, command({{range, 5}, {delay, 1}}));
    EXPECT_NEAR(to_seconds(bench.now), 2 * 5 / 1500.0 + 4.7e-3 + 5130 / 115200.0 + 0.002, 1e-6);
    Bench paced = sounder({{"baud", 115200.0}});
    ask(paced, command({{range, 5}}));
    EXPECT_NEAR(to_seconds(paced.now), 2 * 5 / 1500.0 + 4.7e-3, 1e-6) << "the line takes the rest";
}

TEST(Imagenex852, ByteTwentyOneIsTheRateOfTheReplyIfItIsHonoured) {
    const std::map<int, double> rates{{0x0B, 9600},  {0x03, 14400}, {0x0C, 19200},  {0x04, 28800},
                                      {0x02, 38400}, {0x05, 57600}, {0x06, 115200}, {0x00, 0},
                                      {0x01, 0},     {0xFF, 0}};
    for (const auto& [code, rate] : rates) {
        Bench bench = sounder({{"baud", 115200.0}, {"reply_baud", std::string("honoured")}});
        const Bytes words = command({{range, 5}, {baud, code}});
        bench.say(words);
        bench.hear();
        EXPECT_NEAR(to_seconds(bench.now), 2 * 5 / 1500.0 + 4.7e-3, 1e-6) << "whatever the line takes then";
        const auto sent = bench.sent();
        ASSERT_EQ(sent.size(), 1u);
        EXPECT_EQ(sent[0].line_rate, rate) << code;
        const double end = to_seconds(bench.now) + 5130 / (rate > 0 ? rate : 115200);
        bench.say(command({{baud, 6}}));
        EXPECT_FALSE(bench.ping) << "the line is not free yet";
        EXPECT_NEAR(to_seconds(bench.wake), end, 1e-6) << code;
        bench.run_to(10s);
        EXPECT_EQ(bench.sent().at(0).line_rate, 115200) << "each command says it anew";
        Bench deaf = sounder({{"baud", 115200.0}});
        deaf.say(words);
        deaf.hear();
        EXPECT_EQ(deaf.sent().at(0).line_rate, 0) << "ignored";
    }
}

TEST(Imagenex852, AReplyThatComesAsAWholeHasNoRateAndComesWhenItsLastByteWould) {
    Bench bench = sounder({{"reply_baud", std::string("honoured")}});
    bench.say(command({{range, 5}, {baud, 0x0B}}));
    bench.hear();
    EXPECT_NEAR(to_seconds(bench.now), 2 * 5 / 1500.0 + 4.7e-3 + 5130 / 9600.0, 1e-6);
    EXPECT_EQ(bench.sent().at(0).line_rate, 0);
}

TEST(Imagenex852, WhateverTheSwitchesOneLegalReplyComes) {
    std::mt19937 random(4);
    Bench bench = sounder({{"trigger_rate", 25.0}});
    for (int i = 0; i < 3000; ++i) {
        Bytes words = with_any_switches(command(), random);
        words[trigger] &= 0xFB;  // not automatic
        const auto reply = ask(bench, words);
        ASSERT_THAT(reply.size(), testing::AnyOf(13, 265, 513)) << to_hex(words);
        ASSERT_TRUE(reply.at(7) >= 1 && reply.at(7) <= 50);
        ASSERT_EQ(std::count(reply.begin(), reply.end(), 0xFC), 1) << to_hex(words);
    }
}

TEST(Imagenex852Trigger, WithoutTheInputTheByteMeansNothing) {
    Bench bench = sounder();
    ask(bench, command({{trigger, 6}}));
    bench.run_to(10s);
    EXPECT_TRUE(bench.sent().empty());
    EXPECT_EQ(bench.shots.size(), 1u);
}

TEST(Imagenex852Trigger, ManualWaitsForThePulseButNotLongerThan100Milliseconds) {
    Bench bench = sounder({{"trigger_rate", 25.0}});
    bench.run_to(10ms);
    bench.say(command({{trigger, 2}}));
    EXPECT_FALSE(bench.ping);
    EXPECT_EQ(bench.wake, Time(40ms));
    bench.run_to(1s);
    EXPECT_EQ(bench.sent().size(), 1u) << "armed once";
    Bench slow = sounder({{"trigger_rate", 1.0}});
    slow.run_to(10ms);
    slow.say(command({{trigger, 2}}));
    EXPECT_EQ(slow.wake, Time(110ms));
}

TEST(Imagenex852Trigger, AutomaticSendsAfterEachPulseUntilItIsToldOtherwise) {
    Bench bench = sounder({{"trigger_rate", 5.0}});
    bench.say(command({{trigger, 6}}));
    bench.run_to(2100ms);
    EXPECT_EQ(bench.sent().size(), 10u);
    bench.run_to(2200ms);
    bench.say(command());
    bench.run_to(10s);
    EXPECT_EQ(bench.sent().size(), 2u) << "the shot under way and the one asked for";
    Bench without = sounder({{"trigger_rate", 5.0}, {"status", std::string("41")}});
    without.say(command({{trigger, 6}}));
    without.run_to(2s);
    EXPECT_EQ(without.sent().size(), 1u) << "no automatic trigger in this head";
}

TEST(Imagenex852OnANoisyLine, ServesItsHostAgainWithinOneRequest) {
    Bench bench = sounder();
    NoisyHost host;
    host.words = {to_hex(command()), to_hex(command({{range, 20}, {profile, 1}})),
                  to_hex(command({{points, 25}}))};
    host.request = to_hex(command({{range, 40}}));
    host.is_answer = [](const Send& send) { return send.bytes.size() == 513 && send.bytes[7] == 40; };
    host.patience = 3s;
    expect_no_wedge(bench, host);
}

}  // namespace
}  // namespace echoloop::test
