#include "render/acoustics/short_taps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace echoloop {
namespace {

double correlation_of(const std::vector<double>& taps, std::size_t lag) {
    double sum = 0;
    for (std::size_t i = lag; i < taps.size(); ++i) sum += taps[i] * taps[i - lag];
    return sum;
}

void expect_correlation(const std::vector<double>& taps, const std::vector<double>& wanted) {
    EXPECT_NEAR(correlation_of(taps, 0), 1, 1e-12);
    for (std::size_t lag = 1; lag < wanted.size() + 3; ++lag)
        EXPECT_NEAR(correlation_of(taps, lag), lag < wanted.size() ? wanted[lag] : 0, taps_error) << lag;
}

TEST(ShortTaps, FindsTheFilterThatACorrelationWasMadeOf) {
    const std::vector<double> made{0.8, 0.5, std::sqrt(0.11)};  // no zero outside the unit circle
    std::vector<double> wanted;
    for (std::size_t lag = 0; lag < 3; ++lag) wanted.push_back(correlation_of(made, lag));
    const auto taps = short_taps(wanted);
    ASSERT_EQ(taps.size(), 3);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(taps[i], made[i], 1e-3);
}

TEST(ShortTaps, ASquaredTriangleNeedsAsManyAsItIsLong) {
    const std::vector<double> wanted{1, 16 / 25., 9 / 25., 4 / 25., 1 / 25., 0, 0};  // a pulse of five bins
    const auto taps = short_taps(wanted);
    EXPECT_EQ(taps.size(), 5);
    expect_correlation(taps, wanted);
}

/// The spectrum of a chirp's, sampled as seldom as a Sonic 2024 does, is less than 0 in part.
TEST(ShortTaps, WhatNoFilterHasIsComeNearTo) {
    const std::vector<double> wanted{1, 0.5843, 0.0718, 0.0440, 0.0178, 0.0133, 0.0095, 0.0054};
    const auto taps = short_taps(wanted);
    EXPECT_EQ(taps.size(), 4);
    expect_correlation(taps, wanted);
}

/// An Imagenex 852's: beyond the fourth lag little is left, but four taps are not near enough.
TEST(ShortTaps, TakesOneMoreTapWhereTheFirstFewAreOff) {
    const std::vector<double> wanted{1, 0.6089, 0.0859, 0.0415, 0.0243, 0.0104, 0.0133};
    const auto taps = short_taps(wanted);
    EXPECT_EQ(taps.size(), 5);
    expect_correlation(taps, wanted);
}

/// Lags of an Imagenex 831L's noise.
TEST(ShortTaps, LongCorrelationsHold) {
    const std::vector<double> wanted{1,      0.9271, 0.8184, 0.7123, 0.6102, 0.5131, 0.4222, 0.3382,
                                     0.2622, 0.1948, 0.1367, 0.0884, 0.0504, 0.0230, 0.0065, 0.0005};
    expect_correlation(short_taps(wanted), wanted);
}

TEST(ShortTaps, WhatHardlyCorrelatesIsWhite) {
    EXPECT_EQ(short_taps(std::vector<double>{1, 0.02, 0.01}), std::vector<double>{1});
    EXPECT_EQ(short_taps(std::vector<double>{1}), std::vector<double>{1});
}

/// A correlation that cannot be: no filter has it, and the nearest is given all the same.
TEST(ShortTaps, AnyNumbersEnd) {
    const auto taps = short_taps(std::vector<double>{1, 0.99, -0.99, 0.99});
    ASSERT_FALSE(taps.empty());
    EXPECT_NEAR(correlation_of(taps, 0), 1, 1e-12);
}

}  // namespace
}  // namespace echoloop
