#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "render/acoustics/random.h"
#include "tests/render/acoustics/chain_shots.h"
#include "tests/render/acoustics/statistics.h"

namespace echoloop {
namespace {

using test::chain_shot;
using test::only;
using test::output;
using test::to_db;

/// dB, the mean of what an empty sea sounds like.
double noise_level(const Shot& shot) {
    const auto values = output(only({Effect::pulse, Effect::noise}), shot, 0);
    return to_db(test::sum_of(values) / static_cast<double>(values.size()));
}

TEST(Noise, Mellen) {
    EXPECT_NEAR(thermal_noise_level(750e3), 42.5, 0.01);
    EXPECT_NEAR(thermal_noise_level(100e3), 25, 1e-9);
}

// V9: NL + 10 log B - DI, whatever the bins.
TEST(Noise, LevelInTheReceiversBand) {
    for (const double bin : {0.004, 0.03, 0.3}) {
        Shot shot = chain_shot(40, 2000, bin, 0.03);
        EXPECT_NEAR(noise_level(shot), 42.5 + 10 * std::log10(25e3), 0.1) << "1 / tau, bins of " << bin;
        shot.receiver.bandwidth = 10e3;
        shot.receiver.directivity_index = 28;
        EXPECT_NEAR(noise_level(shot), 42.5 + 40 - 28, 0.15) << "bins of " << bin;
        shot.bandwidth = 20e3;
        shot.receiver.bandwidth = 0;
        EXPECT_NEAR(noise_level(shot), 42.5 + 43.01 - 28, 0.1) << "of a chirp, bins of " << bin;
        shot.pulse_length = 1e-3;
        EXPECT_NEAR(noise_level(shot), 42.5 + 30 - 28, 0.1) << "of a long chirp, compressed, bins of " << bin;
    }
}

TEST(Noise, SelfNoiseAddsItsPower) {
    Shot shot = chain_shot(40, 1000, 0.1, 0.075);
    shot.receiver.bandwidth = 10e3;
    shot.receiver.self_noise = 42.5;
    EXPECT_NEAR(noise_level(shot), 42.5 + 3.01 + 40, 0.1);
    shot.receiver.self_noise = 70;
    EXPECT_NEAR(noise_level(shot), 70 + 40, 0.1);
}

TEST(Noise, IsTheMeanThatIsReturned) {
    Shot shot = chain_shot(40, 1000, 0.1, 0.075);
    shot.receiver.bandwidth = 10e3;
    std::vector<float> values(40'000, 0.0F);
    const double mean = AcousticChain(only({Effect::noise})).apply(shot, {}, test::water_speed, {}, values);
    EXPECT_NEAR(to_db(mean), 82.5, 0.01);
    EXPECT_EQ(AcousticChain(only({Effect::speckle})).apply(shot, {}, test::water_speed, {}, values), 0);
}

TEST(Noise, IsGaussianAndNewInEveryPing) {
    Shot shot = chain_shot(40, 1000, 0.02, 0.075);
    shot.receiver.bins = BinRule::sample;
    const Effects noisy = only({Effect::pulse, Effect::noise});
    const auto first = output(noisy, shot, 0);
    std::vector<float> apart;
    for (std::size_t i = 0; i < first.size(); i += 8) apart.push_back(first[i]);
    EXPECT_NEAR(intensity_statistics(apart).amplitude_cv, 0.5227, 0.015);
    EXPECT_EQ(output(noisy, shot, 0), first);
    shot.ping = 1;
    EXPECT_LT(std::abs(correlation(output(noisy, shot, 0), first)), 0.03);
}

TEST(Noise, OfABandNarrowerThanTheBinsIsCorrelated) {
    Shot shot = chain_shot(1, 50'000, 0.0075, 0.075);  // 10 us bins, 100 us pulse
    shot.receiver.bins = BinRule::sample;
    const auto values = output(only({Effect::pulse, Effect::noise}), shot, 0);
    const std::span<const float> all(values);
    const auto lagged = [&](std::size_t lag) {
        return correlation(all.first(49'000), all.subspan(lag, 49'000));
    };
    EXPECT_NEAR(lagged(5), 0.25, 0.04);  // (1 - 5 / 10)^2
    EXPECT_NEAR(lagged(12), 0, 0.04);
}

// Together they are one Gaussian field of the summed power.
TEST(Noise, AddsToSpeckleAsAField) {
    for (const double bin : {0.02, 0.075}) {
        Shot shot = chain_shot(100, 2000, bin, 0.075);
        shot.receiver.bins = BinRule::sample;
        const double noise = std::pow(10, (42.5 + 40) / 10);
        shot.receiver.bandwidth = 10e3;
        const auto power = static_cast<float>(noise * bin / 0.075);
        const auto values = output(only({Effect::pulse, Effect::speckle, Effect::noise}), shot, power);
        std::vector<float> apart;
        for (std::size_t i = 0; i < values.size(); i += 40) apart.push_back(values[i + 20]);
        const IntensityStatistics s = intensity_statistics(apart);
        EXPECT_NEAR(to_db(s.mean / noise), 3.01, 0.3) << bin;
        EXPECT_NEAR(s.scintillation, 1, 0.12) << bin;
        EXPECT_LT(s.kolmogorov, s.kolmogorov_limit) << bin;
    }
}

TEST(Receiver, SaturationClips) {
    Shot shot = chain_shot(1, 100, 0.1, 0.075);
    shot.receiver.saturation_level = 60;
    EXPECT_NEAR(output(only({Effect::saturation}), shot, 1e7F)[50], 1e6, 1);
    EXPECT_EQ(output(only({Effect::saturation}), shot, 1e5F)[50], 1e5F);
    EXPECT_EQ(output(only({Effect::quantisation}), shot, 1e7F)[50], 1e7F);
}

/// A shot whose staves' noise is that many of their converter's steps.
Shot converted(double noise_in_steps, int staves) {
    Shot shot = chain_shot(64, 2000, 0.1, 0.075);
    shot.horizontal = {ApertureShape::hamming, 1};
    shot.receiver.converter_bits = 16;
    shot.receiver.staves = staves;
    const double stave_noise = to_db(received_noise(shot) * effective_staves(shot));
    shot.receiver.saturation_level = stave_noise - 20 * std::log10(noise_in_steps) + 90.31;
    return shot;
}

// V28: 1/12 of a step's square for each stave, 0.35 dB at a noise of one step and 1.25 dB at half of one.
TEST(Receiver, ConvertersOfStavesAddToTheNoise) {
    for (const int staves : {1, 64, 256})
        for (const auto& [steps, rise] : {std::pair{1.0, 0.35}, {0.5, 1.25}}) {
            const Shot shot = converted(steps, staves);
            const auto of = [&](Effects effects) {
                const auto values = output(effects, shot, 0);
                EXPECT_NEAR(intensity_statistics(values).amplitude_cv, 0.5227, 0.01) << "never steps";
                return to_db(test::sum_of(values) / static_cast<double>(values.size()));
            };
            EXPECT_NEAR(of(only({Effect::noise, Effect::quantisation})) - of(only({Effect::noise})), rise,
                        0.15)
                << staves << " staves";
        }
}

TEST(Receiver, BeamsHaveFinerStepsThanStaves) {
    Shot shot = converted(1, 256);
    shot.receiver.staves = 1;
    const double behind_the_beam = to_db(converter_step(shot));
    shot.receiver.staves = 256;
    EXPECT_NEAR(behind_the_beam - to_db(converter_step(shot)), 24.08 - 1.34, 0.02) << "N_eff 0.734 N";
    shot.horizontal.shape = ApertureShape::line;
    EXPECT_NEAR(behind_the_beam - to_db(converter_step(shot)), 24.08, 0.02);
    shot.receiver.converter_bits = 0;
    EXPECT_EQ(converter_step(shot), 0);
    shot.receiver.converter_bits = 8;
    shot.receiver.saturation_level = std::numeric_limits<double>::infinity();
    EXPECT_EQ(converter_step(shot), 0);
}

TEST(Chain, WithoutEffectsValuesStayAsTheyAre) {
    Shot shot = chain_shot(3, 100, 0.1, 0.4);
    shot.receiver = {10e3, 20, 80, 60, 8};
    std::vector<float> values(300);
    for (std::size_t i = 0; i < 300; ++i) values[i] = static_cast<float>(i * i) * 1e4F;
    const auto before = values;
    EXPECT_EQ(AcousticChain(Effects::none()).apply(shot, {}, test::water_speed, {}, values), 0);
    EXPECT_EQ(values, before);
    const auto point = output(Effects::none(), shot, {{1, 5.01, 7, 2}});
    EXPECT_NEAR(point[150], 7, 1e-5);
    EXPECT_NEAR(test::sum_of(point), 7, 1e-5);
}

// Each beam alone gives the bytes that it gives among others, on however many threads they ran.
TEST(Chain, BeamsDependOnThemselvesOnly) {
    for (const double bin : {0.02, 0.2}) {
        const Shot shot = chain_shot(256, 300, bin, 0.075);
        const auto all = output(Effects(), shot, 1e7F);
        EXPECT_EQ(output(Effects(), shot, 1e7F), all);
        AcousticChain used{Effects()};
        for (int ping = 0; ping < 3; ++ping) {
            std::vector<float> values(all.size(), 1e7F);
            used.apply(shot, {}, test::water_speed, {}, values);
            EXPECT_EQ(values, all) << "what was done before does not matter";
        }
        Shot few = shot;  // fewer than are worth a thread
        few.bearings.resize(40);
        const auto part = output(Effects(), few, 1e7F);
        EXPECT_TRUE(std::equal(part.begin(), part.end(), all.begin()));
    }
}

// A hash that all processors, compilers and numbers of threads agree on. It changes when the random numbers,
// the filters or the order of a sum do; then recorded pings are no longer repeatable, which is worth a line
// in the history.
TEST(Chain, BytesAreTheSameEverywhere) {
    std::uint64_t hash = 0;
    for (const double bin : {0.01, 0.05, 0.1, 0.4})
        for (const double shape : {std::numeric_limits<double>::infinity(), 2.0}) {
            Shot shot = chain_shot(64, 700, bin, 0.075);
            shot.receiver = {20e3, 20, 50, 120, 16};
            if (bin == 0.05) shot.bandwidth = 20e3;
            for (const float value : output(Effects(), shot, 1e8F, {{1, 2, -3}, {}}, {shape}))
                hash = mix(hash, std::bit_cast<std::uint32_t>(value));
        }
    EXPECT_EQ(hash, 1608963181080677985U);
}

TEST(Chain, PointsInAnyOrder) {
    const Shot shot = chain_shot(3, 50, 0.1, 0.075);
    const auto values =
        output(Effects::none(), shot, {{2, 1.05, 2, 0}, {0, 3.05, 3, 0}, {1, 2.05, 4, 0}, {0, 4.05, 5, 0}});
    EXPECT_NEAR(values[110], 2, 1e-5);
    EXPECT_NEAR(values[30], 3, 1e-5);
    EXPECT_NEAR(values[70], 4, 1e-5);
    EXPECT_NEAR(values[40], 5, 1e-5);
}

TEST(Chain, SeveralGeometriesInTurn) {
    AcousticChain chain{Effects()};
    for (const std::size_t bins : {300U, 200U, 400U}) {
        const Shot shot = chain_shot(2, bins, 0.02, 0.075);
        std::vector<float> values(2 * bins, 1e6F);
        chain.apply(shot, {}, test::water_speed, {}, values);
        EXPECT_EQ(values, output(Effects(), shot, 1e6F));
    }
    for (int round = 0; round < 2; ++round)
        for (std::size_t i = 1; i < 12; ++i) {
            const Shot shot = chain_shot(2, 100 * i, 0.02 * static_cast<double>(i), 0.075);
            std::vector<float> values(2 * shot.bins, 1e6F);
            chain.apply(shot, {}, test::water_speed, {}, values);
            EXPECT_EQ(values, output(Effects(), shot, 1e6F));
        }
}

}  // namespace
}  // namespace echoloop
