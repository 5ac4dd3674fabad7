#include "render/fan/spread_echoes.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "render/simd.h"

namespace echoloop {
namespace {

constexpr std::size_t turns = 4;  ///< rows that the echoes of a line take turns in
constexpr int at_once = bins_at_once;

/// Echoes with their densities, base + change * (left + right) in the middle of left..right, and the blocks
/// of bins that they cover.
struct Blocks {
    float *low, *high, *base, *change;
    std::int32_t *first, *blocks;
};

/// `last`: bin of the window. Blocks begin at whole multiples of `step` bins of a row, rows `stride` after
/// each other. Echoes without an amount, and those outside the window, get none. Of what is not a number all
/// comparisons are false.
ECHOLOOP_SIMD
void find_blocks(const EchoArrays in, const std::int32_t* __restrict row, std::int32_t stride, float last,
                 std::int32_t step, int count, float* __restrict low, float* __restrict high,
                 float* __restrict base, float* __restrict change, std::int32_t* __restrict first,
                 std::int32_t* __restrict blocks, std::int32_t* __restrict at) {
    for (int i = 0; i < count; ++i) {
        const float from = in.low[i], to = in.high[i], amount = in.amount[i];
        const float lacking = narrowest_echo - (to - from), more = lacking > 0 ? 0.5F * lacking : 0.0F;
        const float begin = from - more, end = to + more, density = amount / (end - begin);
        const float slope = density * in.slope[i];
        const bool counts = ((amount > 0) | (amount < 0)) & (to >= 0) & (from < last + 1);
        const float inside = begin > 0 ? begin : 0.0F, highest = end < last ? end : last;
        const auto first_bin = static_cast<std::int32_t>(counts ? inside : 0.0F);
        const auto last_bin = static_cast<std::int32_t>(counts ? highest : 0.0F);
        const std::int32_t aligned = first_bin & -step, covered = (last_bin - aligned) / at_once + 1;
        low[i] = begin, high[i] = end < last + 1 ? end : last + 1;  // nothing falls behind the last bin
        base[i] = density - slope * (0.5F * (begin + end)), change[i] = 0.5F * slope;
        first[i] = aligned, at[i] = row[i] * stride + aligned;
        blocks[i] = counts ? covered : 0;
    }
}

/// `at`: where in `rows` each echo's first bin lies.
ECHOLOOP_SIMD
void add_blocks(const Blocks in, const std::int32_t* at, std::size_t count, float* __restrict rows) {
    for (std::size_t i = 0; i < count; ++i) {
        float* __restrict row = rows + at[i];
        const float from = in.low[i], to = in.high[i], level = in.base[i], slope = in.change[i];
        auto bin = static_cast<float>(in.first[i]);
        for (std::int32_t block = 0; block < in.blocks[i]; ++block, row += at_once, bin += at_once)
            for (int k = 0; k < at_once; ++k) {
                const float begin = bin + static_cast<float>(k), end = begin + 1;
                const float left = from > begin ? from : begin, right = to < end ? to : end;
                const float width = right - left, covered = width > 0 ? width : 0.0F;
                row[k] += covered * (level + slope * (left + right));
            }
    }
}

/// The least first bin of all blocks and the last one's end.
ECHOLOOP_SIMD
void find_limits(const std::int32_t* __restrict first, const std::int32_t* __restrict blocks, int count,
                 std::int32_t* begin, std::int32_t* end) {
    constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
    std::int32_t low = *begin, high = *end;
    for (int i = 0; i < count; ++i) {
        const std::int32_t covered = blocks[i] * at_once;
        // As bits: a condition keeps the loop from becoming vectors. Where nothing is covered `first` is 0.
        low = std::min(low, first[i] | ((covered - 1) >> 31 & none));
        high = std::max(high, first[i] + covered);
    }
    *begin = low, *end = high;
}

/// Their sum; and leaves the turns empty.
ECHOLOOP_SIMD
void add_some_turns(float* __restrict rows, std::size_t stride, std::size_t begin, std::size_t end,
                    float* __restrict values) {
    static_assert(turns == 4);
    float* __restrict a = rows, * __restrict b = a + stride, * __restrict c = b + stride, * __restrict d = c + stride;
    for (std::size_t i = begin; i < end; ++i) {
        values[i] = (a[i] + b[i]) + (c[i] + d[i]);
        a[i] = 0, b[i] = 0, c[i] = 0, d[i] = 0;
    }
}

/// The same; `values` are in no near cache.
void add_turns(float* rows, std::size_t stride, BinStretch bins, float* values) {
    constexpr std::size_t part = 128;
    for (std::size_t begin = bins.begin; begin < bins.end; begin += part) {
        prefetch<true>(values + begin + prefetched, part);
        add_some_turns(rows, stride, begin, std::min(begin + part, bins.end), values);
    }
}

/// From turn to turn, of rows of so many floats: whole pages and a quarter of one. A read waits for a write
/// that is a whole number of pages away, as if it were of the same place.
std::size_t stride_of(std::size_t floats) {
    constexpr std::size_t page = 4096 / sizeof(float), quarter = page / turns;
    return (floats + page - quarter - 1) / page * page + quarter;
}

}  // namespace

void EchoSpreader::find(const EchoArrays& echoes, const std::int32_t* row, std::size_t count,
                        std::size_t bins, std::size_t stride, std::int32_t step) {
    for (auto* numbers : {&low_, &high_, &base_, &change_}) numbers->resize(count);
    for (auto* numbers : {&first_, &blocks_, &at_}) numbers->resize(count);
    find_blocks(echoes, row, static_cast<std::int32_t>(stride), static_cast<float>(bins - 1), step,
                static_cast<int>(count), low_.data(), high_.data(), base_.data(), change_.data(),
                first_.data(), blocks_.data(), at_.data());
}

void EchoSpreader::add(std::size_t count, float* rows) {
    add_blocks({low_.data(), high_.data(), base_.data(), change_.data(), first_.data(), blocks_.data()},
               at_.data(), count, rows);
}

BinStretch EchoSpreader::spread(const EchoArrays& echoes, std::size_t count, std::size_t bins,
                                float* values) {
    constexpr std::size_t line = floats_per_line;  // so that a vector lies in one
    const std::size_t stride = stride_of(bins + bins_at_once);
    if (turns_.size() != turns * stride + line) turns_.assign(turns * stride + line, 0.0F);
    void* first_turn = turns_.data();
    std::size_t room = turns_.size() * sizeof(float);
    auto* rows = static_cast<float*>(
        std::align(line * sizeof(float), turns * stride * sizeof(float), first_turn, room));
    while (turn_.size() < count) turn_.push_back(static_cast<std::int32_t>(turn_.size() % turns));
    find(echoes, turn_.data(), count, bins, stride, 1);
    std::int32_t begin = static_cast<std::int32_t>(bins), end = 0;
    find_limits(first_.data(), blocks_.data(), static_cast<int>(count), &begin, &end);
    const BinStretch covered{static_cast<std::size_t>(begin) / line * line,
                             std::min(static_cast<std::size_t>(end), bins)};
    if (covered.empty()) return covered;
    prefetch<true>(values + covered.begin, prefetched);
    add(count, rows);
    add_turns(rows, stride, covered, values);
    return covered;
}

/// Blocks lie at whole multiples of their size, so that what an echo has just written is read as it was
/// written.
void EchoSpreader::spread_over_rows(const EchoArrays& echoes, const std::int32_t* row, std::size_t count,
                                    std::size_t bins, std::size_t stride, float* rows) {
    find(echoes, row, count, bins, stride, at_once);
    add(count, rows);
}

}  // namespace echoloop
