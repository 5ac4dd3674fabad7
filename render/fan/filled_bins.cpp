#include "render/fan/filled_bins.h"

#include <algorithm>

#include "render/simd.h"

namespace echoloop {
namespace {

/// Of whole stretches.
ECHOLOOP_SIMD
std::uint64_t find_bits(const float* __restrict values, std::size_t stretches, std::size_t each) {
    constexpr std::size_t at_once = 16;
    std::uint64_t bits = 0;
    for (std::size_t stretch = 0; stretch < stretches; ++stretch) {
        std::uint32_t any = 0;
        for (std::size_t part = 0; part < each; part += at_once, values += at_once)
            for (std::size_t k = 0; k < at_once; ++k) any |= std::bit_cast<std::uint32_t>(values[k]);
        bits |= std::uint64_t{any != 0 ? 1U : 0U} << stretch;
    }
    return bits;
}

}  // namespace

FilledBins FilledBins::find(const float* row, std::size_t begin, std::size_t end, int shift) {
    if (begin >= end) return {0};
    const std::size_t each = std::size_t{1} << shift, first = begin >> shift, whole = end >> shift;
    FilledBins filled{0};
    if (first < whole) filled.bits = find_bits(row + first * each, whole - first, each) << first;
    if (std::any_of(row + std::max(first, whole) * each, row + end, [](float value) { return value != 0; }))
        filled.bits |= std::uint64_t{1} << whole;
    return filled;
}

}  // namespace echoloop
