// The 881A on the bench: what it answers and where it looks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/emulator/devices/imagenex881a_bench.h"
#include "tests/emulator/devices/noisy_line.h"

namespace echoloop::test {
namespace {

using namespace imagenex881a;
using namespace std::chrono_literals;
using testing::ElementsAre;

int position(const Bytes& reply) { return u14(reply, 5) & 0x1FFF; }
bool clockwise(const Bytes& reply) { return (reply.at(6) & 0x40) != 0; }

std::vector<int> positions(Bench& bench, const Bytes& words, int count) {
    std::vector<int> found;
    for (int i = 0; i < count; ++i) found.push_back(position(ask(bench, words)));
    return found;
}

TEST(Imagenex881a, NeverSaysAWordUnasked) {
    Bench bench = sonar();
    bench.run_to(3600s);
    EXPECT_TRUE(bench.sent().empty());
    EXPECT_EQ(bench.wake, Time::max());
}

TEST(Imagenex881a, AnswersWithPositionRangeAndData) {
    Bench bench = sonar();
    const Bytes reply = ask(bench, command());
    ASSERT_EQ(reply.size(), 513u);
    // IGX, id 10, V5 and accepted, 608 = 4 * 128 + 96 clockwise, 5 m, no profile, 500 = 3 * 128 + 116
    EXPECT_EQ(to_hex(ByteView(reply).first(12)), "494758104160440500007403");
    EXPECT_EQ(reply.back(), 0xFC);
    ASSERT_EQ(bench.shots.size(), 1u);
    const Shot& shot = bench.shots[0];
    EXPECT_NEAR(shot.pan, deg_to_rad(2.4), 1e-9) << "one step to starboard";
    EXPECT_EQ(shot.bins, 500u);
    EXPECT_NEAR(shot.bin_interval * static_cast<double>(shot.bins), 2 * 5 / 1500.0, 1e-12);
    EXPECT_DOUBLE_EQ(shot.frequency, 675e3);
    EXPECT_DOUBLE_EQ(shot.pulse_length, 60e-6);
    EXPECT_NEAR(rad_to_deg(shot.beam_width), 1.8, 1e-9);
}

TEST(Imagenex881a, SizesAndLettersAreThoseOfTheTable) {
    struct Row {
        int points, bits, profile;
        std::size_t bytes;
        char letter;
        int data;
    };
    for (const Row& row : {Row{25, 4, 0, 141, 'M', 128},
                           {25, 8, 0, 265, 'M', 252},
                           {25, 16, 0, 513, 'M', 500},
                           {50, 4, 0, 265, 'G', 252},
                           {50, 8, 0, 513, 'G', 500},
                           {50, 16, 0, 513, 'G', 500},
                           {25, 8, 1, 13, 'P', 0},
                           {50, 16, 1, 13, 'P', 0}}) {
        Bench bench = sonar();
        const auto reply =
            ask(bench, command({{points, row.points}, {bits, row.bits}, {profile, row.profile}}));
        ASSERT_EQ(reply.size(), row.bytes);
        EXPECT_EQ(reply[1], row.letter);
        EXPECT_EQ(u14(reply, 10), row.data);
        EXPECT_EQ(reply.back(), 0xFC);
    }
    Bench old = sonar({{"imx_bytes", std::string("250")}});
    EXPECT_EQ(ask(old, command({{points, 25}})).size(), 263u);
}

TEST(Imagenex881a, OnlyTheAddressedHeadAnswers) {
    Bench bench = sonar();
    EXPECT_TRUE(ask(bench, command({{id, 0x11}})).empty());
    EXPECT_TRUE(bench.shots.empty());
    bench.say("49475811 45780A0A 40037403 010203");  // another head's reply on the pair
    EXPECT_EQ(ask(bench, command()).size(), 513u);
    Bench second = sonar({{"head_id", std::int64_t{0x1E}}});
    EXPECT_TRUE(ask(second, command()).empty());
    EXPECT_EQ(ask(second, command({{id, 0x1E}})).at(3), 0x1E);
}

TEST(Imagenex881a, AModeByteOfZeroIsAnsweredUnlessItIsStrict) {
    Bench bench = sonar(), strict = sonar({{"mode_byte", std::string("strict")}});
    EXPECT_EQ(ask(bench, command({{mode, 0}})).size(), 513u);
    EXPECT_GT(bench.shots.at(0).source_level, 0);
    for (const int bad : {0, 0x03, 0x42, 0x41})
        EXPECT_TRUE(ask(strict, command({{mode, bad}})).empty()) << bad;
    EXPECT_FALSE(ask(strict, command()).empty());
    ask(bench, command({{mode, 0x42}}));
    EXPECT_LT(bench.shots.at(1).source_level, 0) << "no transmission";
}

TEST(Imagenex881a, WhatItCannotDoIsNotAccepted) {
    Bench bench = sonar();
    const auto reply = ask(bench, command({{range, 0}}));
    EXPECT_EQ(reply.at(4), 0x01);
    EXPECT_EQ(reply.at(7), 1);
    EXPECT_EQ(ask(bench, command()).at(4), 0x41);
    Bench older = sonar({{"status", std::string("40")}});
    EXPECT_EQ(ask(older, command()).at(4), 0x40);
}

TEST(Imagenex881a, WhateverTheSwitchesOneLegalReplyComes) {
    std::mt19937 random(3);
    Bench bench = sonar();
    bench.echo_bin = 100;
    for (int i = 0; i < 3000; ++i) {
        const Bytes words = with_any_switches(command(), random);
        bench.echo_power = static_cast<float>(random());
        const Time before = bench.now;
        const auto reply = ask(bench, words);
        ASSERT_THAT(reply.size(), testing::AnyOf(13, 141, 265, 513)) << to_hex(words);
        ASSERT_EQ(reply.size(), 13u + static_cast<std::size_t>(u14(reply, 10)));
        ASSERT_LT(position(reply), 1200);
        ASSERT_EQ(std::count(reply.begin(), reply.end(), 0xFC), 1) << to_hex(words);
        ASSERT_LT(to_seconds(bench.now - before), 2.5);
        ASSERT_LE(bench.shots.back().bins, 5000u);
    }
}

TEST(Imagenex881aScan, ASectorIsSweptToAndFroWithoutPassingItsEdges) {
    Bench bench = sonar(), clipping = sonar({{"sector_edge", std::string("clip")}});
    const auto words = command({{sector, 4}});  // 12 deg: 580 to 620
    EXPECT_THAT(positions(bench, words, 9), ElementsAre(608, 616, 608, 600, 592, 584, 592, 600, 608));
    EXPECT_THAT(positions(clipping, words, 8), ElementsAre(608, 616, 620, 612, 604, 596, 588, 580));
    const auto reply = ask(bench, words);
    EXPECT_EQ(position(reply), 616);
    EXPECT_TRUE(clockwise(reply));
    EXPECT_FALSE(clockwise(ask(bench, words)));
}

TEST(Imagenex881aScan, TheReverseBitTurnsASectorScanRound) {
    Bench bench = sonar();
    EXPECT_THAT(positions(bench, command(), 2), ElementsAre(608, 616));
    EXPECT_THAT(positions(bench, command({{motion, 0x40}}), 3), ElementsAre(608, 600, 592));
    EXPECT_THAT(positions(bench, command(), 2), ElementsAre(600, 608));
}

TEST(Imagenex881aScan, AllAroundItTurnsOnOnTheStepGrid) {
    Bench bench = sonar();
    const auto words = command({{sector, around}, {step, 4}});
    const auto turn = positions(bench, words, 301);
    EXPECT_EQ(turn[149], 0);
    EXPECT_EQ(turn[299], 600) << "300 steps of 1.2 deg later it is where it was";
    EXPECT_EQ(turn[300], 604);
    EXPECT_THAT(positions(bench, command({{sector, around}, {step, 4}, {motion, 0x40}}), 3),
                ElementsAre(600, 596, 592));
    EXPECT_NEAR(bench.shots.back().pan, deg_to_rad(-2.4), 1e-9);
}

TEST(Imagenex881aScan, StepZeroAndHoldKeepThePosition) {
    Bench bench = sonar({{"start_angle", -30.0}});
    EXPECT_THAT(positions(bench, command({{step, 0}}), 3), ElementsAre(500, 500, 500));
    EXPECT_THAT(positions(bench, command({{motion, 1}, {sector, around}}), 2), ElementsAre(500, 500));
    EXPECT_NEAR(bench.shots.back().pan, deg_to_rad(-30), 1e-9);
}

TEST(Imagenex881aScan, OutsideItsSectorItMovesTowardsItTheShortWay) {
    Bench bench = sonar();
    const auto starboard = command({{train, 110}, {sector, 10}});  // +150 deg +- 15: 1050 to 1150
    const auto way = positions(bench, starboard, 57);
    EXPECT_EQ(way[0], 608);
    EXPECT_EQ(way[56], 1056);
    const auto port = command({{train, 5}, {sector, 10}});  // -165 deg +- 15: 0 to 100
    EXPECT_THAT(positions(bench, port, 2), ElementsAre(1064, 1072)) << "through +-180 deg";
    EXPECT_LE(positions(bench, port, 17).back(), 100);
    const auto narrow = command({{train, 60}, {sector, 0}});
    EXPECT_EQ(positions(bench, narrow, 150).back(), 600) << "a sector without width is found and held";
}

TEST(Imagenex881aScan, CalibrationMovesToZeroAndTakesItsTime) {
    Bench bench = sonar({{"start_angle", 90.0}});
    const auto reply = ask(bench, command({{calibrate, 1}, {profile, 1}, {step, 0}}));
    EXPECT_EQ(position(reply), 600);
    EXPECT_NEAR(to_seconds(bench.now), 0.015 + 300 * 0.0024, 1e-6);
}

// 900 = 7 * 128 + 4
const std::string to_90_deg = "FE441F 00000043 00000000 0407 0000000000000000 06 00000000 FD";

TEST(Imagenex881aAzimuth, TheDriveTurnsTheHeadAndSaysSo) {
    Bench bench = sonar({{"azimuth_drive", true}});
    bench.say(to_90_deg);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_EQ(to_hex(sent[0].bytes), "4941581f4004070000000000fc");
    EXPECT_NEAR(to_seconds(sent[0].not_before), 300 * 0.0024, 1e-6);
    ask(bench, command({{step, 0}}));
    EXPECT_NEAR(bench.shots.at(0).pan, deg_to_rad(90), 1e-9);
    Bench without = sonar();
    without.say(to_90_deg);
    EXPECT_TRUE(without.sent().empty());
    EXPECT_THROW(sonar({{"azimuth_drive", true}, {"head_id", std::int64_t{0x1F}}}), std::invalid_argument);
}

TEST(Imagenex881aOnANoisyLine, ServesItsHostAgainWithinOneRequest) {
    Bench bench = sonar();
    NoisyHost host;
    host.words = {to_hex(command()), to_hex(command({{range, 20}, {profile, 1}})),
                  to_hex(command({{range, 3}}))};
    host.request = to_hex(command({{range, 77}}));
    host.is_answer = [](const Send& send) { return send.bytes.size() == 513 && send.bytes[7] == 77; };
    host.patience = 3s;  // a damaged command may ask for 200 m and a switch delay of 510 ms
    expect_no_wedge(bench, host);
}

}  // namespace
}  // namespace echoloop::test
