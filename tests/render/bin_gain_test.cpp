#include "render/fan/bin_gain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace echoloop {
namespace {

const FanPlan no_plan;

/// 0.1 m bins from 0.25 m on, with twice the absorption of 720 kHz.
BinningInput window(bool spreading) {
    BinningInput in{no_plan, {}, {}, {}, EchoRule::radiometric, 0, 0, 0, 1, 0, true, {}};
    in.first_range = 0.25, in.bin_length = 0.1, in.bins = 700;
    in.source_power = 1e20, in.absorption = 0.06, in.spreading = spreading;
    return in;
}

/// Spreading, R^-4 or none, with the R^2 that a solid angle covers.
double gain_at(double range, bool spreading) {
    const double square = range * range;
    return std::exp(-4 * 0.06 * range) * (spreading ? 1 / square : square);
}

class BinGains : public testing::TestWithParam<bool> {};

TEST_P(BinGains, AreThoseOfTheMiddleOfEachBin) {
    const BinGain gain(window(GetParam()));
    ASSERT_EQ(gain.values().size(), 700U);
    for (std::size_t bin = 0; bin < 700; ++bin) {
        const double expected = 1e20 * gain_at(0.25 + (static_cast<double>(bin) + 0.5) * 0.1, GetParam());
        EXPECT_NEAR(static_cast<double>(gain.values()[bin]) / expected, 1, 2e-7) << bin;
    }
}

TEST_P(BinGains, AreThoseOfTheEchosOwnRangeCloseToTheSonar) {
    const BinGain gain(window(GetParam()));
    std::vector<float> range, low, high, amount;
    for (float r = 0.2F; r < 3; r += 0.0137F)
        range.push_back(r), low.push_back(2), high.push_back(2.5F), amount.push_back(3);
    gain.correct(range.data(), low.data(), high.data(), range.size(), amount.data());
    for (std::size_t i = 0; i < range.size(); ++i) {
        const double r = static_cast<double>(range[i]), bin = std::floor((r - 0.25) / 0.1);
        const double middle = std::max(0.25 + bin * 0.1, 0.0) + 0.05;
        const double own = r < 1.6 ? gain_at(r, GetParam()) / gain_at(middle, GetParam()) : 1;
        EXPECT_NEAR(static_cast<double>(amount[i]) / (3 * own), 1, 1e-6) << r;
        if (r < 1.6) {
            EXPECT_NEAR(static_cast<double>(gain.correction(range[i])) / own, 1, 1e-6) << r;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutSpreading, BinGains, testing::Bool());

TEST(BinGain, LeavesAloneWhatIsWideOrHasNoSurface) {
    const BinGain gain(window(true));
    const std::vector<float> range{0.47F, 0.47F, 0, 0.47F}, low{2, 2, 2, 2}, high{3, 2.9F, 2.1F, 2.1F};
    std::vector<float> amount{1, 1, 0, 0};
    gain.correct(range.data(), low.data(), high.data(), range.size(), amount.data());
    EXPECT_EQ(amount[0], 1);
    EXPECT_NE(amount[1], 1);
    EXPECT_EQ(amount[2], 0);
    EXPECT_EQ(amount[3], 0);
}

}  // namespace
}  // namespace echoloop
