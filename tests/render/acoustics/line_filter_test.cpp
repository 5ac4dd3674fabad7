// A line's filter is the sum of its taps, one by one, to the last output.
#include "render/acoustics/line_filter.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace echoloop {
namespace {

constexpr std::ptrdiff_t no_delay = 0, early = -2;

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

TEST(LineFilter, HasATapAtLeast) { EXPECT_THROW(LineFilter(0, {}), std::invalid_argument); }

}  // namespace
}  // namespace echoloop
