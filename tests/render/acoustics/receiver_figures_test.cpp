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

/// Correlation of the logarithms of neighbouring bins of noise, `lag` bins apart.
double likeness(const std::vector<float>& values, std::size_t lag) {
    const auto count = static_cast<double>(values.size() - lag);
    double mean = 0, variance = 0, cross = 0;
    for (const float v : values) mean += to_db(static_cast<double>(v)) / static_cast<double>(values.size());
    for (std::size_t i = 0; i + lag < values.size(); ++i) {
        const double a = to_db(static_cast<double>(values[i])) - mean;
        variance += a * a / count;
        cross += a * (to_db(static_cast<double>(values[i + lag])) - mean) / count;
    }
    return cross / variance;
}

/// Logarithms of two intensities whose fields correlate by r have Li2(r^2) / Li2(1) in common (of bivariate
/// exponential variables; Li2(x) = x + x^2 / 4 + x^3 / 9 + ...).
double of_logarithms(double intensity) {
    double sum = 0;
    for (int k = 1; k < 2000; ++k) sum += std::pow(intensity, k) / (k * k);
    return sum * 6 / (std::numbers::pi * std::numbers::pi);
}

TEST(NoiseCircuit, NoiseCorrelatesOverRangeAsBehindATunedCircuit) {
    Shot shot = noise_shot(water_speed / 2 * 2.2e-6);
    shot.receiver.noise_circuit = 9.2e3;
    const auto values = output(only({Effect::pulse, Effect::noise, Effect::speckle}), shot, 0);
    for (const std::size_t lag : {1U, 3U, 10U}) {
        const double left = std::exp(-2 * std::numbers::pi * 9.2e3 * 2.2e-6 * static_cast<double>(lag));
        EXPECT_NEAR(likeness(values, lag), of_logarithms(left), 0.06) << lag;
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
