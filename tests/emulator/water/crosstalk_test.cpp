// Two sonars in one water: when one hears the other's pulse, in which bins and beams, and how loud.
#include "emulator/water/crosstalk.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/acoustics/pattern.h"

namespace echoloop {
namespace {

constexpr double c = 1500;
constexpr Time start = std::chrono::seconds(100);

Water water() {
    Water out;
    out.sound_speed = c;
    return out;
}

/// 100 bins of 0.1 ms.
Shot shot_of(double frequency = 750e3, std::size_t beams = 1) {
    Shot shot;
    for (std::size_t i = 0; i < beams; ++i) shot.bearings.push_back(0.1 * static_cast<double>(i));
    shot.beam_width = 0.1;
    shot.fan_height = 0.5;
    shot.bins = 100;
    shot.bin_interval = 1e-4;
    shot.frequency = frequency;
    shot.pulse_length = 1e-4;
    shot.source_level = 200;
    return shot;
}

Echogram silence(const Shot& shot) {
    Echogram out;
    out.shot = shot;
    out.sound_speed = c;
    out.values.assign(shot.bearings.size() * shot.bins, 0.0F);
    return out;
}

const Effects steady = Effects{}.set(Effect::speckle, false).set(Effect::absorption, false);

/// Looks east from the origin; the other is 3 m to the east and looks back.
const Transmission own{start, 0, {}, shot_of()};
Transmission other(Time after_us = std::chrono::microseconds(1000), double frequency = 750e3) {
    return {start + after_us, 1, {{3, 0, 0}, axis_angle({0, 0, 1}, std::numbers::pi)}, shot_of(frequency)};
}

Echogram heard(const Transmission& pulse, const Effects& effects = steady,
               const Transmission& receiver = own) {
    CrossTalk cross_talk(water(), effects);
    cross_talk.transmitted(receiver);
    cross_talk.transmitted(pulse);
    Echogram echogram = silence(receiver.shot);
    cross_talk.add(cross_talk.pulses_in(echogram, receiver), echogram);
    return echogram;
}

double total(const Echogram& echogram) {
    double sum = 0;
    for (const float value : echogram.values) sum += value;
    return sum;
}

// Sent 1 ms after the own pulse, 2 ms on the way: bin 30, at SL - 20 log 3.
TEST(CrossTalk, PulseArrivesWhenAndAsLoudAsOneWaySays) {
    const Echogram echogram = heard(other());
    EXPECT_NEAR(level_db(echogram.values[30]), 200 - 20 * std::log10(3), 0.01);
    EXPECT_NEAR(total(echogram) / echogram.values[30], 1, 1e-5);
}

// The own sonar has two sides and lies across: its port side looks east, where the other is.
TEST(CrossTalk, SidesHearAndSendByThemselves) {
    Transmission two_sided = own;
    two_sided.world_from_sonar.orientation = axis_angle({0, 0, 1}, -std::numbers::pi / 2);
    two_sided.shot.bearings = {-std::numbers::pi / 2, std::numbers::pi / 2};
    two_sided.shot.sides = {{0, 203}, {0, 190}};
    const Echogram received = heard(other(), steady, two_sided);
    EXPECT_NEAR(level_db(received.beam(0)[30]), 200 - 20 * std::log10(3), 0.01);
    EXPECT_LT(level_db(received.beam(1)[30]), level_db(received.beam(0)[30]) - 39);
    Transmission late = two_sided;
    late.time = start + std::chrono::microseconds(1000), late.device = 1;
    Transmission single = other();
    single.time = start, single.device = 0;
    const Echogram sent = heard(late, steady, single);
    EXPECT_NEAR(level_db(sent.values[30]), 203 - 20 * std::log10(3), 0.01);
}

TEST(CrossTalk, PulseCoversTheBinsThatItLasts) {
    Transmission pulse = other(std::chrono::microseconds(1050));
    pulse.shot.pulse_length = 2.5e-4;
    pulse.shot.bandwidth = 1e4;
    const Echogram echogram = heard(pulse);
    const float full = echogram.values[31];
    EXPECT_NEAR(echogram.values[30] / full, 0.5, 1e-3);
    EXPECT_NEAR(echogram.values[32] / full, 1, 1e-3);
    EXPECT_NEAR(echogram.values[33] / full, 0, 1e-3);
    EXPECT_NEAR(total(echogram) / full, 2.5, 1e-3);
}

TEST(CrossTalk, SentBeforeTheOwnPulseItIsHeardAllTheSame) {
    EXPECT_GT(heard(other(std::chrono::microseconds(-1500))).values[5], 0);
    EXPECT_EQ(total(heard(other(std::chrono::microseconds(-2200)))), 0);  // over before the window began
    EXPECT_EQ(total(heard(other(std::chrono::microseconds(8100)))), 0);   // arrives when it has ended
}

TEST(CrossTalk, OtherBandsAreNotHeard) {
    EXPECT_EQ(total(heard(other(std::chrono::microseconds(1000), 900e3))), 0);
    // 10 kHz wide both, 5 kHz apart: half the energy.
    const double half = total(heard(other(std::chrono::microseconds(1000), 755e3)));
    EXPECT_NEAR(half / total(heard(other())), 0.5, 1e-3);
}

TEST(CrossTalk, NobodyHearsItselfOrWhatIsSwitchedOff) {
    Transmission same = other();
    same.device = 0;
    EXPECT_EQ(total(heard(same)), 0);
    Effects off = steady;
    EXPECT_EQ(total(heard(other(), off.set(Effect::cross_talk, false))), 0);
}

TEST(CrossTalk, PatternsOfBothEndsCount) {
    // The other looks away: what its housing radiates is left.
    Transmission away = other();
    away.world_from_sonar.orientation = {};
    EXPECT_NEAR(level_db(heard(away).values[30]), 200 - 20 * std::log10(3) + CrossTalk::side_level, 0.01);
    // The receiver is turned aside by 0.04 rad: one way of its pattern.
    Transmission turned = own;
    turned.shot.pan = 0.04;
    const TwoWayPattern pattern(own.shot.horizontal, own.shot.beam_width);
    EXPECT_NEAR(level_db(heard(other(), steady, turned).values[30]),
                200 - 20 * std::log10(3) + 20 * std::log10(pattern.amplitude(0.04)), 0.01);
}

TEST(CrossTalk, EveryBeamOfAFanHearsWithItsOwnPattern) {
    Transmission fan = own;
    fan.shot = shot_of(750e3, 3);
    fan.shot.horizontal.ways = 1;
    const Echogram echogram = heard(other(), steady, fan);
    const TwoWayPattern pattern(fan.shot.horizontal, fan.shot.beam_width);
    for (std::size_t beam = 0; beam < 3; ++beam)
        EXPECT_NEAR(echogram.beam(beam)[30] / echogram.beam(0)[30],
                    std::pow(pattern.amplitude(0.1 * static_cast<double>(beam)), 2), 1e-4);
}

TEST(CrossTalk, FluctuatesWithTheRightMeanAndTheSameAgain) {
    Effects effects;
    effects.set(Effect::absorption, false);
    double sum = 0, squares = 0;
    constexpr int pings = 2000;
    for (int i = 0; i < pings; ++i) {
        Transmission ping = own;
        ping.shot.ping = static_cast<std::uint64_t>(i);
        const double power = heard(other(), effects, ping).values[30];
        sum += power / pings;
        squares += power * power / pings;
    }
    const double mean = std::pow(10, 20 - 2 * std::log10(3));
    EXPECT_NEAR(sum / mean, 1, 0.08);
    EXPECT_NEAR(squares / (sum * sum), 2, 0.3);  // exponential
    EXPECT_EQ(heard(other(), effects).values, heard(other(), effects).values);
}

TEST(CrossTalk, ReceiverClips) {
    Transmission receiver = own;
    receiver.shot.receiver.saturation_level = 150;
    EXPECT_NEAR(level_db(heard(other(), steady, receiver).values[30]), 150, 0.01);
}

TEST(CrossTalk, FindsThePulseAmongManyPings) {
    CrossTalk cross_talk(water(), steady);
    for (int i = 0; i < 2000; ++i) cross_talk.transmitted(other(std::chrono::milliseconds(50) * (i - 1900)));
    cross_talk.transmitted(own);
    Echogram echogram = silence(own.shot);
    cross_talk.add(cross_talk.pulses_in(echogram, own), echogram);
    EXPECT_GT(echogram.values[20], 0);  // the one sent together with the own pulse
    EXPECT_NEAR(total(echogram) / echogram.values[20], 1, 1e-5);
}

// 5 rows of 5 beams, 0.1 rad apart; the pulse comes from straight ahead.
TEST(CrossTalk, RowsOfBeamsHearAPulseWhereItComesFrom) {
    Transmission receiver = own;
    receiver.shot.bearings = receiver.shot.elevations = {-0.2, -0.1, 0, 0.1, 0.2};
    receiver.shot.fan_height = 0.1;
    receiver.shot.horizontal = receiver.shot.vertical = {ApertureShape::hamming, 1};
    const Echogram echo = [&] {
        CrossTalk cross_talk(water(), steady);
        cross_talk.transmitted(other());
        Echogram silent = silence(receiver.shot);
        silent.values.assign(25 * 100, 0.0F);
        cross_talk.add(cross_talk.pulses_in(silent, receiver), silent);
        return silent;
    }();
    const auto power = [&](std::size_t row, std::size_t column) {
        return echo.values[(row * 5 + column) * 100 + 30];
    };
    EXPECT_GT(power(2, 2), 0);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_FLOAT_EQ(power(2, i), power(i, 2)) << "alike across and upwards";
        EXPECT_LT(power(i, 4), 0.01F * power(2, 2));
        EXPECT_LT(power(4, i), 0.01F * power(2, 2));
    }
    // And what has rows transmits over all of them.
    Transmission sender = other();
    sender.shot.bearings = sender.shot.elevations = {-0.2, 0.2};
    sender.shot.fan_height = 0.1;
    const float ahead = heard(sender).values[30];
    sender.world_from_sonar.orientation =
        axis_angle({0, 0, 1}, std::numbers::pi) * axis_angle({0, 1, 0}, 0.15);
    EXPECT_FLOAT_EQ(heard(sender).values[30], ahead);
    sender.world_from_sonar.orientation =
        axis_angle({0, 0, 1}, std::numbers::pi) * axis_angle({0, 1, 0}, 0.5);
    EXPECT_LT(heard(sender).values[30], 0.01F * ahead);
}

}  // namespace
}  // namespace echoloop
