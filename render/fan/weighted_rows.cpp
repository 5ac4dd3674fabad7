#include "render/fan/weighted_rows.h"

#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "render/simd.h"

namespace echoloop {
namespace {

constexpr std::size_t rows_at_once = 64;
/// Of each stretch, which of 64 rows have it.
using RowsOfStretches = std::array<std::uint64_t, rows_at_once>;

struct Sums {
    std::span<const WeightedRow> rows;
    const float* gain;
    std::size_t bins, count;
    float* out;
    std::span<const RowsOfStretches> filled;
};

/// Bit k of word i becomes bit i of word k (Warren, Hacker's Delight, 2002, section 7-3).
ECHOLOOP_SIMD
void transpose(RowsOfStretches& rows) {
    std::uint64_t mask = 0x00000000FFFFFFFFULL;
    for (std::size_t half = 32; half != 0; half /= 2, mask ^= mask << half)
        for (std::size_t first = 0; first < rows.size(); first += 2 * half)
            for (std::size_t k = first; k < first + half; ++k) {
                const std::uint64_t swapped = (rows[k] >> half ^ rows[k + half]) & mask;
                rows[k] ^= swapped << half;
                rows[k + half] ^= swapped;
            }
}

/// Sums the bins in tiles of `across` vectors each; the last tile ends with the last bin, and does again what
/// it shares with the one before. Gives the number of bins, or 0 where there is no tile. `Vector` is no wider
/// than the processor's, and the sums of a tile fit into its registers: where either is not so, the compiler
/// keeps the sums in memory, and the loop takes three times as long.
template <class Vector, std::size_t across>
ECHOLOOP_INLINE std::size_t sum_tiles_of(const Sums& in) {
    constexpr std::size_t lanes = sizeof(Vector) / sizeof(float), tile = across * lanes;
    if (in.bins < tile) return 0;
    const int shift = FilledBins::shift_of(in.bins);
    for (std::size_t next = 0; next < in.bins; next += tile) {
        const std::size_t at = next + tile <= in.bins ? next : in.bins - tile;
        Vector sum[sums_at_once][across] = {};
        const WeightedRow* rows = in.rows.data();
        for (const RowsOfStretches& filled : in.filled) {
            std::uint64_t left = 0;
            for (std::size_t k = at >> shift; k <= (at + tile - 1) >> shift; ++k) left |= filled[k];
            for (; left != 0; left &= left - 1) {
                const WeightedRow& row = rows[std::countr_zero(left)];
                // So many rows are read in turns that no processor sees that each of them goes on.
                prefetch(row.values + at + tile, tile);
#pragma GCC unroll 4
                for (std::size_t i = 0; i < across; ++i) {
                    Vector values;
                    std::memcpy(&values, row.values + at + i * lanes, sizeof values);
#pragma GCC unroll 4
                    for (std::size_t k = 0; k < sums_at_once; ++k) sum[k][i] += row.weights[k] * values;
                }
            }
            rows += rows_at_once;
        }
#pragma GCC unroll 4
        for (std::size_t i = 0; i < across; ++i) {
            Vector factor = Vector{} + 1.0F;
            if (in.gain != nullptr) std::memcpy(&factor, in.gain + at + i * lanes, sizeof factor);
#pragma GCC unroll 4
            for (std::size_t k = 0; k < sums_at_once; ++k) {
                const Vector value = sum[k][i] * factor;
                if (k < in.count) std::memcpy(in.out + k * in.bins + at + i * lanes, &value, sizeof value);
            }
        }
    }
    return in.bins;
}

#ifdef ECHOLOOP_SIMD_VERSIONS
__attribute__((target("arch=x86-64-v4"))) std::size_t sum_tiles(const Sums& in) {
    return sum_tiles_of<Sixteen, 2>(in);
}

__attribute__((target("arch=x86-64-v3"))) std::size_t sum_tiles(const Sums& in) {
    return sum_tiles_of<Eight, 2>(in);
}

__attribute__((target("default")))
#endif
std::size_t
sum_tiles(const Sums& in) {
    return sum_tiles_of<Four, 2>(in);
}

}  // namespace

void sum_rows(std::span<const WeightedRow> rows, const float* gain, std::size_t bins, std::size_t sums,
              float* out) {
    static thread_local std::vector<RowsOfStretches> filled;
    filled.assign((rows.size() + rows_at_once - 1) / rows_at_once, {});
    for (std::size_t i = 0; i < rows.size(); ++i)
        filled[i / rows_at_once][i % rows_at_once] = rows[i].filled.bits;
    for (RowsOfStretches& block : filled) transpose(block);
    const std::size_t summed = sum_tiles({rows, gain, bins, sums, out, filled});
    for (std::size_t k = 0; k < sums; ++k)
        for (std::size_t i = summed; i < bins; ++i) {
            float sum = 0;
            for (const WeightedRow& row : rows) sum += row.weights[k] * row.values[i];
            out[k * bins + i] = gain != nullptr ? sum * gain[i] : sum;
        }
}

}  // namespace echoloop
