// Echoes that are spread eight bins at once lie where each by itself would, and nothing beside them changes.
#include "render/fan/spread_echoes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace echoloop {
namespace {

constexpr std::size_t bins = 101;
constexpr float nan = std::numeric_limits<float>::quiet_NaN(), far_away = 1e9F;

struct Echoes {
    std::vector<float> low, high, amount, slope;

    void add(float from, float to, float value, float change = 0) {
        low.push_back(from), high.push_back(to), amount.push_back(value), slope.push_back(change);
    }
    std::size_t size() const { return low.size(); }
    EchoArrays arrays() const { return {low.data(), high.data(), amount.data(), slope.data()}; }
};

/// Narrow ones, usual ones and wide ones, within the window, across its ends and beyond them; and those that
/// are none.
Echoes many(bool slopes) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> place(-20, 120), share(0, 1);
    Echoes echoes;
    for (int i = 0; i < 500; ++i) {
        const float from = place(random), width = i % 7 == 0 ? 40 * share(random) : 0.1F + 5 * share(random);
        echoes.add(from, from + width, share(random), slopes ? -share(random) * 1.8F / width : 0);
    }
    echoes.add(50.25F, 50.25F, 1), echoes.add(0, 0, 1), echoes.add(100.5F, 101, 1);
    for (const float other : {nan, far_away, -far_away}) echoes.add(other, other + 1, 1);
    echoes.add(30, nan, 1), echoes.add(30, 31, 0), echoes.add(30, 31, nan);
    return echoes;
}

/// What an echo adds to each bin: its density, which changes evenly, in the middle of what it covers.
std::vector<double> expected(const Echoes& echoes, std::size_t i) {
    std::vector<double> out(bins);
    const double middle = 0.5 * (double{echoes.low[i]} + double{echoes.high[i]});
    const double width = std::max(double{echoes.high[i]} - double{echoes.low[i]}, double{narrowest_echo});
    const double from = middle - width / 2, to = middle + width / 2,
                 density = double{echoes.amount[i]} / width;
    if (!(echoes.amount[i] > 0) || !(echoes.high[i] >= 0 && echoes.low[i] < bins)) return out;
    for (std::size_t bin = 0; bin < bins; ++bin) {
        const double left = std::max(from, static_cast<double>(bin)),
                     right = std::min(to, static_cast<double>(bin + 1));
        const double change = density * double{echoes.slope[i]};
        if (right > left) out[bin] = (right - left) * (density + change * (0.5 * (left + right) - middle));
    }
    return out;
}

TEST(SpreadEchoes, LieWhereTheyBelong) {
    for (const bool slopes : {false, true}) {
        const Echoes echoes = many(slopes);
        std::vector<double> sums(bins);
        for (std::size_t i = 0; i < echoes.size(); ++i) {
            const auto one = expected(echoes, i);
            for (std::size_t bin = 0; bin < bins; ++bin) sums[bin] += one[bin];
        }
        std::vector<float> values(bins + 1);
        values.back() = -7;
        EchoSpreader spreader;
        for (int time = 1; time <= 2; ++time) {  // it keeps nothing of the first, nor what was there
            const BinStretch covered = spreader.spread(echoes.arrays(), echoes.size(), bins, values.data());
            EXPECT_EQ(covered.begin, 0);
            EXPECT_EQ(covered.end, bins);
            for (std::size_t bin = 0; bin < bins; ++bin)
                EXPECT_NEAR(values[bin], sums[bin], 5e-5 * sums[bin] + 1e-6) << bin;
            EXPECT_EQ(values.back(), -7) << "beyond the last bin";
        }
    }
}

TEST(SpreadEchoes, EachInItsRow) {
    constexpr std::size_t rows = 5, stride = bins + 3;
    Echoes echoes = many(true);
    std::vector<std::int32_t> row(echoes.size());
    std::vector<double> sums(rows * stride);
    for (std::size_t i = 0; i < echoes.size(); ++i) {
        row[i] = static_cast<std::int32_t>(i % rows);
        const auto one = expected(echoes, i);
        for (std::size_t bin = 0; bin < bins; ++bin) sums[i % rows * stride + bin] += one[bin];
    }
    std::vector<float> values(rows * stride + bins_at_once);
    EchoSpreader spreader;
    spreader.spread_over_rows(echoes.arrays(), row.data(), echoes.size(), bins, stride, values.data());
    for (std::size_t i = 0; i < sums.size(); ++i) EXPECT_NEAR(values[i], sums[i], 5e-5 * sums[i] + 1e-6) << i;
    for (std::size_t i = 0; i < bins_at_once; ++i) EXPECT_EQ(values[rows * stride + i], 0);
}

TEST(SpreadEchoes, NothingIsNothing) {
    std::vector<float> values(bins, 1);
    Echoes echoes;
    EchoSpreader spreader;
    EXPECT_TRUE(spreader.spread(echoes.arrays(), 0, bins, values.data()).empty());
    echoes.add(-3, -1, 1), echoes.add(101, 104, 1), echoes.add(3, 4, 0), echoes.add(nan, nan, 1);
    EXPECT_TRUE(spreader.spread(echoes.arrays(), echoes.size(), bins, values.data()).empty());
    EXPECT_EQ(values, std::vector<float>(bins, 1));
}

}  // namespace
}  // namespace echoloop
