#include "render/acoustics/lean_kernels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "render/simd.h"

namespace echoloop::kernels {

namespace {

ECHOLOOP_INLINE bool differ_in(const float* a, const float* b, float ratio, float least, std::size_t count) {
    int more = 0;
    for (std::size_t i = 0; i < count; ++i)
        more |= static_cast<int>(a[i] > ratio * b[i] + least) | static_cast<int>(b[i] > ratio * a[i] + least);
    return more != 0;
}

}  // namespace

ECHOLOOP_SIMD void differ(const float* a, const float* b, float ratio, float least, std::size_t count,
                          bool* differs) {
    const std::size_t whole = count / lean_block;
    for (std::size_t k = 0; k < whole; ++k)
        differs[k] |= differ_in(a + k * lean_block, b + k * lean_block, ratio, least, lean_block);
    if (const std::size_t first = whole * lean_block; first < count)
        differs[whole] |= differ_in(a + first, b + first, ratio, least, count - first);
}

namespace {

/// Natural logarithm of a normal float x > 0, |error| < 1e-4 (own fit of least greatest error).
ECHOLOOP_INLINE float rough_log(float x) {
    const auto bits = std::bit_cast<std::int32_t>(x);
    const std::int32_t exponent = (bits - 0x3F3504F3) >> 23;  // what is left is within sqrt(1/2)..sqrt(2)
    const float m = std::bit_cast<float>(bits - exponent * (1 << 23)) - 1;
    const float p = 0.99935231F + m * (-0.50246523F + m * (0.35871053F - 0.22848286F * m));
    return m * p + 0.69314718F * static_cast<float>(exponent);
}

}  // namespace

ECHOLOOP_SIMD void add_log_ratio(float scale, const float* a, const float* b, std::size_t count, float* out) {
    constexpr float nothing = 1e-12F;
    for (std::size_t i = 0; i < count; ++i)
        out[i] += scale * rough_log(std::max(a[i], nothing) / std::max(b[i], nothing));
}

ECHOLOOP_SIMD void limit(float most, std::size_t count, float* values) {
    for (std::size_t i = 0; i < count; ++i) values[i] = std::min(std::max(-most, values[i]), most);
}

/// Part of shift(): a pair in memory keeps the loop from becoming vectors, and so do the least and the
/// greatest of floats. Of whole numbers they do not.
ECHOLOOP_SIMD void shift_and_bound(float by, std::size_t count, float* __restrict places, std::int32_t* least,
                                   std::int32_t* most) {
    std::int32_t low = std::numeric_limits<std::int32_t>::max(),
                 high = std::numeric_limits<std::int32_t>::min();
    for (std::size_t i = 0; i < count; ++i) {
        const float place = places[i] + by;
        places[i] = place;
        const auto whole = static_cast<std::int32_t>(place);
        const std::int32_t below = whole - static_cast<std::int32_t>(place < static_cast<float>(whole));
        low = below < low ? below : low;
        high = below > high ? below : high;
    }
    *least = low, *most = high;
}

std::pair<int, int> shift(float by, std::size_t count, float* places) {
    std::int32_t least = 0, most = 0;
    shift_and_bound(by, count, places, &least, &most);
    return {least, most};
}

namespace {

/// Sums of the cells' numbers by their weights, and the weights' energy; at least two vectors of bins, of
/// which the last ones do again what they share with those before. Written in vectors: of loops over bins
/// and cells g++ 12 makes single numbers.
template <class Vector>
ECHOLOOP_INLINE void sum_cells_of(const CellFields& cells, const float* places, std::size_t count,
                                  float* sums, float* energies) {
    constexpr std::size_t across = 2, lanes = sizeof(Vector) / sizeof(float), tile = across * lanes;
    const auto end = static_cast<int>(cells.count);
    for (std::size_t next = 0; next < count; next += tile) {
        const std::size_t at = std::min(next, count - tile);
        Vector place[across], sum[across] = {}, energy[across] = {};
#pragma GCC unroll 2
        for (std::size_t i = 0; i < across; ++i)  // g++ copies arrays of vectors in halves
            std::memcpy(&place[i], places + at + i * lanes, sizeof place[i]);
        Vector lowest = place[0], highest = place[0];
#pragma GCC unroll 2
        for (std::size_t i = 1; i < across; ++i) {
            lowest = lowest < place[i] ? lowest : place[i];
            highest = highest > place[i] ? highest : place[i];
        }
        float least = lowest[0], most = highest[0];
        for (std::size_t i = 1; i < lanes; ++i)
            least = std::min(least, lowest[i]), most = std::max(most, highest[i]);
        const int from = std::max(static_cast<int>(std::floor(least)) + 1 - cells.beside - cells.first, 0),
                  to = std::min(static_cast<int>(std::floor(most)) + 1 + cells.beside - cells.first, end);
        for (int k = from; k < to; ++k) {
            const auto cell = static_cast<float>(cells.first + k);
            const float* field = cells.fields[k] + at;
#pragma GCC unroll 2
            for (std::size_t i = 0; i < across; ++i) {
                Vector values;
                std::memcpy(&values, field + i * lanes, sizeof values);
                const Vector distance = place[i] - cell, all = distance * distance * cells.per_reach;
                const Vector s = all < 1.0F ? all : Vector{} + 1.0F, rest = 1.0F - s;
                const Vector weight = rest * rest * (1.0F + cells.middle * s);
                sum[i] += weight * values, energy[i] += weight * weight;
            }
        }
#pragma GCC unroll 2
        for (std::size_t i = 0; i < across; ++i) {
            std::memcpy(sums + at + i * lanes, &sum[i], sizeof sum[i]);
            std::memcpy(energies + at + i * lanes, &energy[i], sizeof energy[i]);
        }
    }
}

#ifdef ECHOLOOP_SIMD_VERSIONS
__attribute__((target("arch=x86-64-v4"))) void sum_cells(const CellFields& cells, const float* places,
                                                         std::size_t count, float* sums, float* energies) {
    sum_cells_of<Sixteen>(cells, places, count, sums, energies);
}

__attribute__((target("arch=x86-64-v3"))) void sum_cells(const CellFields& cells, const float* places,
                                                         std::size_t count, float* sums, float* energies) {
    sum_cells_of<Eight>(cells, places, count, sums, energies);
}

__attribute__((target("default")))
#endif
void
sum_cells(const CellFields& cells, const float* places, std::size_t count, float* sums, float* energies) {
    sum_cells_of<Four>(cells, places, count, sums, energies);
}

/// The same of fewer bins.
void sum_cells_of_few(const CellFields& cells, const float* places, std::size_t count, float* sums,
                      float* energies) {
    for (std::size_t i = 0; i < count; ++i) {
        float sum = 0, energy = 0;
        for (std::size_t k = 0; k < cells.count; ++k) {
            const float distance = places[i] - static_cast<float>(cells.first + static_cast<int>(k));
            const float s = std::min(distance * distance * cells.per_reach, 1.0F), rest = 1 - s;
            const float weight = rest * rest * (1 + cells.middle * s);
            sum += weight * cells.fields[k][i], energy += weight * weight;
        }
        sums[i] = sum, energies[i] = energy;
    }
}

ECHOLOOP_SIMD void divide_by_roots(const float* squares, std::size_t count, float* values) {
    for (std::size_t i = 0; i < count; ++i) values[i] /= std::sqrt(squares[i]);
}

}  // namespace

void hear_cells(const CellFields& cells, const float* places, std::size_t count, float* energies,
                float* out) {
    constexpr std::size_t most_at_once = 32;
    if (count < most_at_once)
        sum_cells_of_few(cells, places, count, out, energies);
    else
        sum_cells(cells, places, count, out, energies);
    divide_by_roots(energies, count, out);
}

}  // namespace echoloop::kernels
