// The 881A on the bench: what it answers, when, and where it looks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/emulator/devices/imagenex_bench.h"
#include "tests/emulator/devices/noisy_line.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

// A host's command: id 10, 5 m, 20 dB, LOGF 20, 0.2 dB/m, 0 deg, 60 deg sector, 2.4 deg steps, 60 us, 500
// points.
const std::string plain = "FE44100500004300140114 3C1408060000000032080600000064FD";
enum At {
    id = 2,
    range,
    motion = 5,
    mode,
    gain = 8,
    logf,
    absorption,
    train,
    sector,
    step,
    pulse,
    least,
    points = 19,
    bits,
    baud,
    profile,
    calibrate,
    delay,
    frequency
};
constexpr int around = 120;

Bytes command(const Changes& changes = {}) { return changed(plain, changes); }
Bench sonar(const Options& changes = {}) { return Bench(make_device("imagenex-881a", {}, changes)); }

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

struct Cell {
    int range, step, profile;
    double turn;  ///< s
};
void PrintTo(const Cell& cell, std::ostream* out) { *out << cell.range << " m, step " << cell.step; }
class Imagenex881aTable : public testing::TestWithParam<Cell> {};

TEST_P(Imagenex881aTable, ATurnTakesWhatTheMakerSays) {
    const Cell cell = GetParam();
    const int shots = 1200 / cell.step;
    for (const double rate : {0.0, 115200.0}) {
        Bench bench = sonar({{"baud", rate}});
        const auto words = command({{range, cell.range},
                                    {sector, around},
                                    {step, cell.step},
                                    {points, 25},
                                    {profile, cell.profile}});
        for (int i = 0; i < shots; ++i) {
            const auto reply = ask(bench, words);
            if (rate > 0)
                bench.run_to(bench.now + from_seconds(10 * static_cast<double>(reply.size()) / rate));
        }
        EXPECT_NEAR(to_seconds(bench.now) / shots, cell.turn / shots, 0.0021) << rate;
    }
}

INSTANTIATE_TEST_SUITE_P(Maker, Imagenex881aTable,
                         testing::Values(Cell{200, 1, 0, 355.2}, Cell{200, 8, 0, 47.0}, Cell{100, 4, 0, 48.6},
                                         Cell{50, 3, 0, 38.0}, Cell{10, 2, 0, 24.6}, Cell{1, 1, 0, 33.6},
                                         Cell{1, 8, 0, 6.7}, Cell{200, 1, 1, 328.8}, Cell{100, 4, 1, 44.1},
                                         Cell{20, 8, 1, 7.4}, Cell{5, 8, 1, 4.4}, Cell{2, 1, 1, 18.0}));

TEST(Imagenex881aTime, OtherTimingsAndTheSwitchDelay) {
    const double wire = 5130 / 115200.0, window = 2 * 5 / 1500.0;
    Bench bench = sonar({{"timing", std::string("none")}});
    ask(bench, command({{delay, 100}}));
    EXPECT_NEAR(to_seconds(bench.now), window + wire + 0.2, 1e-6);
    Bench fixed = sonar({{"timing", std::string("fixed")}, {"fixed_time", 0.25}});
    ask(fixed, command());
    EXPECT_NEAR(to_seconds(fixed.now), 0.25, 1e-6);
    Bench slow = sonar({{"timing", std::string("none")}, {"reply_baud", std::string("honoured")}});
    ask(slow, command({{baud, 0x0B}}));
    EXPECT_NEAR(to_seconds(slow.now), window + 5130 / 9600.0, 1e-6);
}

TEST(Imagenex881aTime, OfTheCommandsThatComeMeanwhileOnlyTheNewestIsServed) {
    Bench bench = sonar();
    bench.say(command({{range, 50}}));
    for (const int r : {10, 20, 30}) bench.say(command({{range, r}}));
    bench.run_to(2s);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 2u);
    EXPECT_EQ(sent[0].bytes[7], 50);
    EXPECT_EQ(sent[1].bytes[7], 30);
}

TEST(Imagenex881aTime, ANewHostHearsNoReplyToTheOldOne) {
    Bench bench = sonar();
    bench.say(command());
    bench.say(Bytes{0xFE, 0x44, 0x10});
    bench.device().reconnected(0);
    bench.run_to(1s);
    EXPECT_TRUE(bench.sent().empty());
    EXPECT_EQ(ask(bench, command()).size(), 513u);
}

TEST(Imagenex881aData, ProfileRangeIsInMillimetresOrCentimetres) {
    Bench bench = sonar();
    bench.echo_power = 1e20F;
    bench.echo_bin = 617;  // of 2000 samples of 2 mm
    EXPECT_EQ(u14(ask(bench, command({{range, 4}, {profile, 1}})), 8), 617);
    EXPECT_EQ(bench.shots.back().bins, 2000u);
    bench.echo_bin = 350;  // of 1000 samples of 10 mm
    EXPECT_EQ(u14(ask(bench, command({{range, 10}, {profile, 1}})), 8), 350);
    EXPECT_EQ(u14(ask(bench, command({{range, 10}})), 8), 350) << "with echo data, too";
    EXPECT_EQ(u14(ask(bench, command({{range, 10}, {profile, 1}, {least, 35}})), 8), 350);
    EXPECT_EQ(u14(ask(bench, command({{range, 10}, {profile, 1}, {least, 36}})), 8), 0)
        << "nearer than 3.6 m";
    bench.echo_power = 1;
    EXPECT_EQ(u14(ask(bench, command({{range, 10}, {profile, 1}})), 8), 0) << "below the threshold";
}

/// Count of an echo of `level` dB in sample 400 of 500 over 5 m, that is at 4.005 m.
int count_of(Bench& bench, double level, const Changes& changes) {
    bench.echo_bin = 400;
    bench.echo_power = static_cast<float>(std::pow(10.0, level / 10));
    return ask(bench, command(changes)).at(12 + 400);
}

TEST(Imagenex881aData, GainAndTimeVariedGainAreTheHosts) {
    Bench bench = sonar();
    const auto expected = [](double level, double gained, double k, double a) {
        const double shown = level + gained + k * std::log10(4.005) + 2 * a * 4.005 - 175;
        return static_cast<int>(128 * std::pow(10.0, shown / 20));
    };
    EXPECT_EQ(count_of(bench, 135, {}), expected(135, 20, 20, 0.2));
    EXPECT_GT(expected(135, 20, 20, 0.2), 30);
    EXPECT_EQ(count_of(bench, 135, {{gain, 26}}), expected(135, 26, 20, 0.2)) << "6 dB are a factor of two";
    EXPECT_EQ(count_of(bench, 135, {{logf, 0}}), expected(135, 20, 10, 0.2));
    EXPECT_EQ(count_of(bench, 135, {{logf, 3}, {gain, 0}}), expected(135, 0, 40, 0.2));
    EXPECT_EQ(count_of(bench, 135, {{absorption, 50}}), expected(135, 20, 20, 0.5));
    EXPECT_EQ(count_of(bench, 190, {}), 127) << "the ceiling";
    Bench full = sonar({{"echo_ceiling", std::string("255")}});
    EXPECT_EQ(count_of(full, 190, {}), 255);
}

TEST(Imagenex881aData, FourAndSixteenBits) {
    Bench bench = sonar();
    bench.echo_bin = 300;
    bench.echo_power = 1e20F;
    auto reply = ask(bench, command({{points, 50}, {bits, 4}}));  // 504 points of one sample
    EXPECT_EQ(reply.at(12 + 150), 0x0F) << "an even point is the low nibble";
    bench.echo_bin = 301;
    reply = ask(bench, command({{points, 50}, {bits, 4}}));
    EXPECT_EQ(reply.at(12 + 150), 0xF0);
    reply = ask(bench, command({{bits, 16}}));  // 250 points of two samples
    EXPECT_EQ(reply.at(12 + 300), 0xFF);
    EXPECT_EQ(reply.at(12 + 301), 0xFF);
    Bench packed = sonar({{"data_16_bit", std::string("7+7")}});
    packed.echo_bin = 301;
    packed.echo_power = 1e20F;
    reply = ask(packed, command({{bits, 16}}));
    EXPECT_EQ(reply.at(12 + 300), 0x7F);
    EXPECT_EQ(reply.at(12 + 301), 0x7F);
}

TEST(Imagenex881aData, NoDataByteEndsTheReplyForWhoReadsToTheFirstFC) {
    // 252.5 of 256: level for LOGF 20, 0.2 dB/m, 20 dB at 4.005 m
    const double level = 175 - 20 - 20 * std::log10(4.005) - 0.4 * 4.005 + 20 * std::log10(252.5 / 256);
    Bench avoiding = sonar({{"echo_ceiling", std::string("255")}});
    EXPECT_EQ(count_of(avoiding, level, {}), 0xFB);
    Bench keeping = sonar({{"echo_ceiling", std::string("255")}, {"fc_in_data", std::string("kept")}});
    EXPECT_EQ(count_of(keeping, level, {}), 0xFC);
}

TEST(Imagenex881aSound, FrequencyAndPulseAreTheHosts) {
    Bench bench = sonar();
    ask(bench, command({{frequency, 27}, {pulse, 54}}));
    EXPECT_DOUBLE_EQ(bench.shots.at(0).frequency, 310e3);
    EXPECT_DOUBLE_EQ(bench.shots.at(0).pulse_length, 540e-6);
    EXPECT_NEAR(rad_to_deg(bench.shots.at(0).beam_width), 3.9, 0.05) << "the maker says 4 x 40 deg";
    EXPECT_NEAR(rad_to_deg(bench.shots.at(0).fan_height), 43.5, 0.1);
    ask(bench, command({{frequency, 165}}));
    EXPECT_DOUBLE_EQ(bench.shots.at(1).frequency, 1000e3);
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
