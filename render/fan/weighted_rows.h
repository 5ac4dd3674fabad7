// The inner loop of summing rows of bins with weights: several sums at once, so that each row is read once
// for all of them, and no sum is read and written again for every row. Knows no beams.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "render/fan/filled_bins.h"

namespace echoloop {

inline constexpr std::size_t sums_at_once = 4;

/// A row of bins, 0 but where it is filled, and its weight in each sum.
struct WeightedRow {
    const float* values;
    FilledBins filled;
    std::array<float, sums_at_once> weights;
};

/// Sets each of up to `sums_at_once` sums, `bins` long and one behind the other, to those of the rows, added
/// in their order, times `gain` (one for each bin), unless that is null.
void sum_rows(std::span<const WeightedRow> rows, const float* gain, std::size_t bins, std::size_t sums,
              float* out);

}  // namespace echoloop
