// The 881A on the bench: when it answers, and what its levels become in the reply.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/emulator/devices/imagenex881a_bench.h"

namespace echoloop::test {
namespace {

using namespace imagenex881a;
using namespace std::chrono_literals;

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

}  // namespace
}  // namespace echoloop::test
