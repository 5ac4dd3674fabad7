// Ring-down and interference: what they add to silence, and what they leave alone.
#include "render/acoustics/ring_down.h"

#include <gtest/gtest.h>

#include "render/acoustics/interference.h"
#include "tests/render/acoustics/chain_shots.h"

namespace echoloop::test {
namespace {

constexpr double bin = 0.015;  // m: 20 us

Shot ringing(RingDown ring, std::size_t beams = 1, std::size_t bins = 100) {
    Shot shot = chain_shot(beams, bins, bin, bin);
    shot.receiver.ring_down = std::make_shared<RingDown>(std::move(ring));
    return shot;
}

std::vector<float> rung(const Shot& shot) { return output(only({Effect::ring_down}), shot, 0.0F); }

TEST(RingDown, FollowsItsCurveBelowTheSourceLevel) {
    const auto values = rung(ringing({{{100e-6, -60, 0, 0}, {500e-6, -80, 0, 0}, {1e-3, -80, 0, 0}}}));
    EXPECT_EQ(values[4], 0) << "90 us: before it";
    EXPECT_NEAR(level_db(values[5]), 200 - 60.5, 0.01) << "110 us";
    EXPECT_NEAR(level_db(values[15]), 200 - 70.5, 0.01) << "310 us";
    EXPECT_NEAR(level_db(values[40]), 200 - 80, 0.01);
    EXPECT_EQ(values[50], 0) << "1010 us: after it";
}

TEST(RingDown, ComesLaterWithALongerPulse) {
    RingDown ring{{{0, -60, 0, 0}, {100e-6, -60, 0, 0}, {300e-6, -100, 0, 0}}, 20e-6, {}};
    Shot shot = ringing(ring);
    shot.pulse_length = 20e-6;
    const auto a = rung(shot);
    shot.pulse_length = 220e-6;  // 10 bins
    const auto b = rung(shot);
    EXPECT_NEAR(level_db(b[0]), 140, 0.01);
    for (std::size_t i = 6; i < 14; ++i) EXPECT_NEAR(level_db(b[i + 10]), level_db(a[i]), 0.01) << i;
}

TEST(RingDown, AShotThatDoesNotSendHasNone) {
    Shot shot = ringing({{{0, -60, 0, 0}, {1e-3, -60, 0, 0}}});
    shot.source_level = -300;
    EXPECT_EQ(rung(shot), std::vector<float>(100, 0.0F));
}

TEST(RingDown, ScattersFromPingToPingAndSomeOfItLasts) {
    RingDown ring{{{0, -60, 4, 3}, {1.2e-3, -60, 4, 3}}, 0, {}};
    constexpr std::size_t pings = 2000, at = 20;
    // Over pings only the scatter; over units both.
    const auto spread = [&](bool units) {
        double sum = 0, squares = 0;
        for (std::size_t i = 0; i < pings; ++i) {
            Shot shot = ringing(ring);
            (units ? shot.random_key : shot.ping) = i;
            const double db = static_cast<double>(level_db(rung(shot)[at])) - 140;
            sum += db;
            squares += db * db;
        }
        return std::sqrt(squares / pings - sum * sum / pings / pings);
    };
    EXPECT_NEAR(spread(false), 4, 0.3);
    EXPECT_NEAR(spread(true), 5, 0.3);
}

TEST(RingDown, ScatterIsCorrelatedOverSomeBins) {
    RingDown ring{{{0, -60, 5, 0}, {1, -60, 5, 0}}, 0, {}};
    const Shot shot = ringing(ring, 1, 20000);
    const auto values = rung(shot);
    const auto correlation = [&](std::size_t lag) {
        double sum = 0;
        for (std::size_t i = 0; i + lag < values.size(); ++i)
            sum += (static_cast<double>(level_db(values[i])) - 140) *
                   (static_cast<double>(level_db(values[i + lag])) - 140);
        return sum / static_cast<double>(values.size() - lag) / 25;
    };
    EXPECT_NEAR(correlation(0), 1, 0.1);
    EXPECT_GT(correlation(1), 0.8);
    EXPECT_NEAR(correlation(8), 0, 0.1);
}

TEST(RingDown, BearingsAreThoseOfTheCarrierWhereverTheHeadLooks) {
    // Astern, port, ahead, starboard.
    Shot shot = ringing({{{0, -60, 0, 2}, {1e-3, -60, 0, 2}}, 0, {1, 0, -1, 3}});
    const auto ahead = [&](double bearing) {
        shot.pan = deg_to_rad(bearing);
        return level_db(rung(shot)[10]) - 140;
    };
    EXPECT_NEAR(ahead(0), -2, 0.01);
    EXPECT_NEAR(ahead(90), 6, 0.01);
    EXPECT_NEAR(ahead(-90), 0, 0.01);
    EXPECT_NEAR(ahead(180), 2, 0.01);
    EXPECT_NEAR(ahead(45), 2, 0.01) << "half-way";
}

TEST(RingDown, BeamsBesideEachOtherAreAlike) {
    RingDown ring{{{0, -60, 5, 0}, {1e-3, -60, 5, 0}}, 0, {}};
    Shot shot = ringing(ring, 400);
    for (double& bearing : shot.bearings) bearing *= 0.25;  // a quarter of a width apart
    const auto values = rung(shot);
    double near = 0, far = 0, squares = 0;
    for (std::size_t beam = 0; beam + 40 < 400; ++beam) {
        const auto db = [&](std::size_t b) {
            return static_cast<double>(level_db(values[b * 100 + 10])) - 140;
        };
        near += db(beam) * db(beam + 1);
        far += db(beam) * db(beam + 40);
        squares += db(beam) * db(beam);
    }
    EXPECT_GT(near / squares, 0.8);
    EXPECT_NEAR(far / squares, 0, 0.4);
}

TEST(RingDown, OffOrAbsentItChangesNoByte) {
    Shot shot = chain_shot(8, 100, bin, bin);
    const auto plain = output({}, shot, 1e8F);
    shot.receiver.ring_down =
        std::make_shared<RingDown>(RingDown{{{0, -60, 5, 5}, {1e-3, -60, 5, 5}}, 0, {}});
    shot.receiver.interference = std::make_shared<Interference>(Interference{1, 10, 0, 1000, 150, 0, {}});
    Effects effects;
    EXPECT_NE(output(effects, shot, 1e8F), plain);
    effects.set(Effect::ring_down, false).set(Effect::interference, false);
    EXPECT_EQ(output(effects, shot, 1e8F), plain);
}

TEST(RingDown, BytesDependOnSeedAndPingAlone) {
    // Enough values that several threads share them, and beams of a smaller shot that have their own work
    // memory.
    RingDown ring{{{0, -60, 5, 5}, {1e-3, -60, 5, 5}}, 0, {}};
    Shot shot = ringing(ring, 200, 200);
    shot.receiver.interference =
        std::make_shared<Interference>(Interference{0.5, 6, 3, 200, 120, 6, {{0.2, 0.4, 5}}});
    const Effects effects = only({Effect::ring_down, Effect::interference, Effect::noise});
    const auto all = output(effects, shot, 0.0F);
    AcousticChain chain(effects);
    std::vector<float> again(all.size(), 0.0F);
    Shot other = shot;
    other.ping = 9;
    chain.apply(other, {}, water_speed, {}, again);
    EXPECT_NE(again, all);
    std::fill(again.begin(), again.end(), 0.0F);
    chain.apply(shot, {}, water_speed, {}, again);
    EXPECT_EQ(again, all);
}

Shot disturbed(Interference rule, std::size_t beams, std::size_t bins) {
    Shot shot = chain_shot(beams, bins, bin, bin);
    shot.receiver.interference = std::make_shared<Interference>(std::move(rule));
    return shot;
}

TEST(InterferenceTest, LiftsLinesAsOftenAndAsMuchAsItSays) {
    Interference rule;
    rule.lines = 0.13;
    rule.lift = 8;
    rule.lift_spread = 1;
    constexpr std::size_t beams = 2000, bins = 200;
    Shot shot = disturbed(rule, beams, bins);
    for (double& b : shot.bearings) b /= 100;  // within a turn
    AcousticChain chain(only({Effect::noise, Effect::interference}));
    std::vector<float> values(beams * bins, 0.0F);
    const double noise = chain.apply(shot, {}, water_speed, {}, values);
    double lifted = 0, db = 0;
    for (std::size_t beam = 0; beam < beams; ++beam) {
        double sum = 0;
        for (std::size_t i = 0; i < bins; ++i) sum += static_cast<double>(values[beam * bins + i]) / bins;
        if (to_db(sum / noise) > 3) ++lifted, db += to_db(sum / noise);
    }
    EXPECT_NEAR(lifted / beams, 0.13, 0.025);
    EXPECT_NEAR(db / lifted, 8, 0.4);
    shot.receiver.interference = nullptr;
    // The beams lie within 20 deg and share their noise: 4,000 numbers a ping.
    constexpr int pings = 10;
    double mean = 0;
    for (int ping = 0; ping < pings; ++ping) {
        ++shot.ping;
        for (float& v : values) v = 0;
        chain.apply(shot, {}, water_speed, {}, values);
        mean += sum_of(values) / static_cast<double>(values.size()) / pings;
    }
    EXPECT_NEAR(mean / noise, 1, 0.02);
}

TEST(InterferenceTest, DashesHaveOneToThreeBins) {
    Interference rule;
    rule.dashes = 50;  // in 0.2 s of listening: 10 a line
    rule.dash_level = 100;
    constexpr std::size_t bins = 10'000;
    double dashes = 0, at_most_one = 0;
    for (std::uint64_t ping = 0; ping < 200; ++ping) {
        Shot shot = disturbed(rule, 1, bins);
        shot.ping = ping;
        const auto values = output(only({Effect::interference}), shot, 0.0F);
        for (std::size_t i = 0; i < bins;) {
            std::size_t length = 0;
            while (i + length < bins && values[i + length] > 0) ++length;
            if (length > 0) {
                ++dashes;
                at_most_one += length == 1;
                EXPECT_LE(length, 6U) << "two of them can touch";
                EXPECT_NEAR(level_db(values[i]), 100, 3.1);
            }
            i += std::max<std::size_t>(length, 1);
        }
    }
    EXPECT_NEAR(dashes / 200, 10, 0.7);
    EXPECT_GT(at_most_one / dashes, 0.6);
}

TEST(InterferenceTest, StripesStandOnTheirBeams) {
    Interference rule;
    rule.stripes = {{128 / 256.0, 136 / 256.0, 6}};
    Shot shot = disturbed(rule, 256, 2000);
    for (double& b : shot.bearings) b /= 4;
    AcousticChain chain(only({Effect::noise, Effect::interference}));
    std::vector<float> values(256 * 2000, 0.0F);
    const double noise = chain.apply(shot, {}, water_speed, {}, values);
    for (std::size_t beam = 120; beam < 144; ++beam) {
        double sum = 0;
        for (std::size_t i = 0; i < 2000; ++i) sum += static_cast<double>(values[beam * 2000 + i]) / 2000;
        EXPECT_NEAR(to_db(sum / noise), beam >= 128 && beam <= 135 ? 6 : 0, 0.6) << beam;
    }
}

}  // namespace
}  // namespace echoloop::test
