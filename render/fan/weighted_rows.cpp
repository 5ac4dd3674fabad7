#include "render/fan/weighted_rows.h"

#include <algorithm>
#include <cstring>

#include "render/simd.h"

namespace echoloop {
namespace {

constexpr std::size_t tile = 16;
using Tile = float __attribute__((vector_size(tile * sizeof(float))));  // as many registers as it takes

inline void load(Tile& to, const float* from) { std::memcpy(&to, from, sizeof to); }

/// The bins of whole tiles.
ECHOLOOP_SIMD
void sum_tiles(const WeightedRow* rows, std::size_t count, const float* gain, std::size_t bins,
               std::size_t sums, float* out) {
    for (std::size_t at = 0; at + tile <= bins; at += tile) {
        Tile a{}, b{}, c{}, d{};
        for (const WeightedRow* row = rows; row != rows + count; ++row) {
            if (row->end <= at || row->begin >= at + tile) continue;
            Tile values;
            load(values, row->values + at);
            a += row->weights[0] * values;
            b += row->weights[1] * values;
            c += row->weights[2] * values;
            d += row->weights[3] * values;
        }
        if (gain != nullptr) {
            Tile factor;
            load(factor, gain + at);
            a *= factor, b *= factor, c *= factor, d *= factor;
        }
        const Tile all[sums_at_once] = {a, b, c, d};
        for (std::size_t k = 0; k < sums; ++k) std::memcpy(out + k * bins + at, &all[k], sizeof(Tile));
    }
}

}  // namespace

void sum_rows(std::span<const WeightedRow> rows, const float* gain, std::size_t bins, std::size_t sums,
              float* out) {
    sum_tiles(rows.data(), rows.size(), gain, bins, sums, out);
    for (std::size_t k = 0; k < sums; ++k)
        for (std::size_t i = bins / tile * tile; i < bins; ++i) {
            float sum = 0;
            for (const WeightedRow& row : rows) sum += row.weights[k] * row.values[i];
            out[k * bins + i] = gain != nullptr ? sum * gain[i] : sum;
        }
}

}  // namespace echoloop
