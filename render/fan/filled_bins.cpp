#include "render/fan/filled_bins.h"

#include <algorithm>
#include <cstring>

namespace echoloop {
namespace {

/// Of whole stretches. By vectors that every processor has, since their bits have to come together in the
/// end.
std::uint64_t find_bits(const float* values, std::size_t stretches, std::size_t each) {
    using Words = std::uint64_t __attribute__((vector_size(16)));
    constexpr std::size_t floats = sizeof(Words) / sizeof(float), at_once = 4 * floats;
    std::uint64_t bits = 0;
    for (std::size_t stretch = 0; stretch < stretches; ++stretch) {
        Words any{};
        for (std::size_t part = 0; part < each; part += at_once, values += at_once) {
            Words words[4];
            std::memcpy(words, values, sizeof words);
            any |= (words[0] | words[1]) | (words[2] | words[3]);
        }
        bits |= std::uint64_t{(any[0] | any[1]) != 0 ? 1U : 0U} << stretch;
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
