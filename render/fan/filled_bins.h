// Which bins of a row may be other than 0, so that who sums rows can leave out the others.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace echoloop {

/// Where a row of bins may be other than 0: a bit for each stretch of so many bins that 64 bits do. Shadows
/// and what lies behind the last surface leave half of a usual fan's stretches empty.
struct FilledBins {
    std::uint64_t bits = ~std::uint64_t{0};

    /// Bins to a bit, whole vectors of them: 1 << shift_of().
    static constexpr int shift_of(std::size_t bins) {
        constexpr int least = 4, bits_log2 = 6;
        return bins == 0 ? least : std::max(least, static_cast<int>(std::bit_width(bins - 1)) - bits_log2);
    }
    /// Bins begin..end - 1 of a row with that shift.
    static constexpr FilledBins within(std::size_t begin, std::size_t end, int shift) {
        if (begin >= end) return {0};
        return {~std::uint64_t{0} << (begin >> shift) & ~std::uint64_t{0} >> (63 - ((end - 1) >> shift))};
    }
    /// Looks at bins begin..end - 1 of the row; the others are 0.
    static FilledBins find(const float* row, std::size_t begin, std::size_t end, int shift);
    friend FilledBins operator|(FilledBins a, FilledBins b) { return {a.bits | b.bits}; }
};

}  // namespace echoloop
