// The chain's loops over bins, against their formulas bin by bin in doubles.
#include "render/acoustics/chain_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/acoustics/bin_law.h"
#include "render/acoustics/random.h"

namespace echoloop {
namespace {

constexpr std::size_t most = 700;

/// Even numbers from `low` to `high`.
std::vector<float> numbers(std::uint64_t key, double low, double high) {
    std::vector<float> out(most);
    for (std::size_t i = 0; i < most; ++i)
        out[i] = static_cast<float>(low + (high - low) * static_cast<double>(mix(key, i) >> 11U) * 0x1p-53);
    return out;
}

/// The intensity of a law between two, `share` of the way to `echo`.
double intensity(const BinLaw& echo, const BinLaw& noise, double share, double z) {
    z = std::clamp(z, -5.7, 5.7);
    double root = 0;
    for (std::size_t k = BinLaw::terms; k-- > 0;)
        root = root * z + (double{noise.root[k]} + share * (double{echo.root[k]} - double{noise.root[k]}));
    return std::pow(std::max(root, 0.0), 3);
}

TEST(ChainKernels, ScatterEchoAndNoiseAsOneField) {
    const BinLaw one = bin_law(BinRule::mean, 1), peak = bin_law(BinRule::peak, 3);
    const auto echo = numbers(1, -6, 6), noise = numbers(2, -6, 6), mean = numbers(3, 0, 9),
               within = numbers(4, -1, 4);
    std::vector<float> fresh(most);  // in three bins of five
    std::ranges::transform(within, fresh.begin(), [](float v) { return std::max(v, 0.0F); });
    constexpr float beside = 2;
    for (const BinLaw& of_echo : {one, peak})
        for (const std::size_t count : {1U, 7U, 31U, 255U, 256U, 257U, 600U}) {
            std::vector<float> power(most, -9);
            kernels::scatter({echo.data(), of_echo.root.data()}, {noise.data(), one.root.data()},
                             {beside, fresh.data()}, count, mean.data(), power.data());
            for (std::size_t i = 0; i < count; ++i) {
                const double whole = double{mean[i]} + beside;
                const double share = std::max(double{mean[i]} - double{fresh[i]}, 0.0) / whole;
                const double z = share * double{echo[i]} + std::sqrt(1 - share * share) * double{noise[i]};
                const double wanted = whole * intensity(of_echo, one, share, z);
                EXPECT_NEAR(power[i], wanted, 2e-5 * (wanted + whole)) << "bin " << i << " of " << count;
            }
            EXPECT_EQ(power[count], -9) << "beyond the last of " << count;
        }
}

TEST(ChainKernels, MultiplyByTheLaw) {
    const BinLaw law = bin_law(BinRule::mean, 1.4);
    const auto z = numbers(5, -6, 6), before = numbers(6, 0, 5);
    for (const std::size_t count : {1U, 33U, 256U, 611U}) {
        std::vector<float> power = before;
        kernels::multiply_by_law(law.root.data(), z.data(), count, power.data());
        for (std::size_t i = 0; i < count; ++i) {
            const double wanted = double{before[i]} * intensity(law, law, 0, double{z[i]});
            EXPECT_NEAR(power[i], wanted, 2e-5 * (wanted + 1)) << "bin " << i << " of " << count;
        }
        EXPECT_EQ(power[count], before[count]) << "beyond the last of " << count;
    }
}

}  // namespace
}  // namespace echoloop
