// What a profile may say of a receiver: how many looks a bin takes, and a tuned circuit that noise comes
// through.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "render/acoustics/beam_chain.h"
#include "tests/render/acoustics/chain_shots.h"
#include "tests/render/acoustics/statistics.h"

namespace echoloop::test {
namespace {

Shot noise_shot(double bin) {
    Shot shot = chain_shot(1, 60'000, bin, 0.0075);
    shot.receiver.bandwidth = 68e3;
    return shot;
}

/// Correlation of intensities that lie `lag` bins apart.
double likeness(const std::vector<float>& values, std::size_t lag) {
    const double mean = sum_of(values) / static_cast<double>(values.size());
    double variance = 0, cross = 0;
    for (std::size_t i = 0; i + lag < values.size(); ++i) {
        const double a = static_cast<double>(values[i]) - mean;
        variance += a * a;
        cross += a * (static_cast<double>(values[i + lag]) - mean);
    }
    return cross / variance;
}

TEST(NoiseCircuit, NoiseCorrelatesOverRangeAsBehindATunedCircuit) {
    Shot shot = noise_shot(water_speed / 2 * 2.2e-6);
    shot.receiver.noise_circuit = 9.2e3;
    const auto values = output(only({Effect::pulse, Effect::noise, Effect::speckle}), shot, 0);
    for (const std::size_t lag : {1U, 3U, 10U}) {
        const double left = std::exp(-2 * std::numbers::pi * 9.2e3 * 2.2e-6 * static_cast<double>(lag));
        EXPECT_GT(likeness(values, lag), left - 0.06) << lag;
        EXPECT_LT(likeness(values, lag), left + 0.02) << lag;
    }
}

TEST(NoiseCircuit, LongBinsHaveNothingInCommon) {
    Shot shot = noise_shot(0.1);
    shot.receiver.noise_circuit = 9.2e3;
    EXPECT_NEAR(likeness(output(only({Effect::pulse, Effect::noise, Effect::speckle}), shot, 0), 1), 0, 0.02);
}

TEST(MostLooks, ALongBinScattersAsTheLooksThatItTakes) {
    Shot shot = chain_shot(1, 100, 0.1, 0.0075);
    shot.receiver.bins = BinRule::peak;
    const auto looks = [&shot] {
        return ChainPlan(shot, water_speed, only({Effect::pulse, Effect::speckle}), {}).echo.looks;
    };
    EXPECT_GT(looks(), 10);
    shot.receiver.most_looks = 5;
    EXPECT_EQ(looks(), 5);
    EXPECT_NEAR(ChainPlan(shot, water_speed, only({Effect::pulse, Effect::speckle}), {}).echo.law.mean,
                1 + 1 / 2.0 + 1 / 3.0 + 1 / 4.0 + 1 / 5.0, 1e-6);
}

}  // namespace
}  // namespace echoloop::test
