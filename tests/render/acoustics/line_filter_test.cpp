// A line's filter is the sum of its taps, one by one, to the last output.
#include "render/acoustics/line_filter.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace echoloop {
namespace {

constexpr std::ptrdiff_t no_delay = 0, early = -2, late = 3;

TEST(LineFilter, AddsWhatItsTapsMakeOfTheInput) {
    for (const std::size_t count : {1U, 32U, 37U})
        for (const std::size_t tap_count : {1U, 2U, 7U})
            for (const std::ptrdiff_t first : {no_delay, early}) {
                std::vector<float> taps;
                for (std::size_t k = 0; k < tap_count; ++k) taps.push_back(static_cast<float>(k + 1));
                const LineFilter filter(first, taps);
                std::vector<float> padded(filter.room(count)), out(count), scratch;
                for (std::size_t i = 0; i < padded.size(); ++i) padded[i] = static_cast<float>(i * i % 17);
                const std::vector<float> in = padded;
                filter.apply(padded, count, out.data(), scratch);
                for (std::size_t j = 0; j < count; ++j) {
                    float sum = 0;
                    for (std::size_t k = 0; k < tap_count; ++k)
                        sum += taps[k] * in[static_cast<std::size_t>(
                                                static_cast<std::ptrdiff_t>(j + filter.before()) - first) -
                                            k];
                    EXPECT_EQ(out[j], sum)
                        << "output " << j << " of " << count << ", " << tap_count << " taps";
                }
            }
}

TEST(LineFilter, FiltersAShortRowWhereItLies) {
    for (const std::size_t count : {1U, 2U, 5U, 37U})
        for (const std::size_t tap_count : {1U, 2U, 7U, 8U})
            for (const std::ptrdiff_t first : {no_delay, early, late}) {
                std::vector<float> taps;
                for (std::size_t k = 0; k < tap_count; ++k) taps.push_back(static_cast<float>(k + 1));
                const LineFilter filter(first, taps);
                ASSERT_TRUE(filter.is_short());
                std::vector<float> values(count), out(count), padded(filter.room(count)), expected(count),
                    scratch;
                for (std::size_t i = 0; i < count; ++i)
                    padded[filter.before() + i] = values[i] = static_cast<float>(i * i % 17 + 1);
                filter.filter(values, out.data());
                filter.apply(padded, count, expected.data(), scratch);
                EXPECT_EQ(out, expected) << count << " bins, " << tap_count << " taps from " << first;
            }
    EXPECT_FALSE(LineFilter(0, std::vector<float>(9, 1)).is_short());
    EXPECT_FALSE(LineFilter::boxed(3, 1, 0, {1}).is_short());
}

TEST(LineFilter, HasATapAtLeast) { EXPECT_THROW(LineFilter(0, {}), std::invalid_argument); }

TEST(LineFilter, MovedByAPartOfABinItFiltersWhatLiesBetweenTwoBins) {
    constexpr std::size_t count = 50;
    constexpr float share = 0.3F;
    std::vector<float> in(200), between(200), scratch;
    for (std::size_t i = 0; i < in.size(); ++i) in[i] = static_cast<float>((i * i * 7 + 3 * i) % 31) - 15;
    for (std::size_t i = 0; i + 1 < in.size(); ++i) between[i] = (1 - share) * in[i] + share * in[i + 1];
    for (const LineFilter& filter : {LineFilter(), LineFilter(0, {0.5F, 2, -1}), LineFilter(-2, {1, 3, 1}),
                                     LineFilter::boxed(4.5, 2, 0, {1, 2})}) {
        const LineFilter moved = filter.moved(share);
        std::vector<float> wanted(count), got(count), left = between, right = in;
        // Both begin with what the first output needs before itself.
        const std::size_t start = 60;
        filter.apply(std::span(left).subspan(start - filter.before(), filter.room(count)), count,
                     wanted.data(), scratch);
        moved.apply(std::span(right).subspan(start - moved.before(), moved.room(count)), count, got.data(),
                    scratch);
        for (std::size_t i = 0; i < count; ++i) EXPECT_NEAR(got[i], wanted[i], 2e-4) << i;
    }
}

}  // namespace
}  // namespace echoloop
