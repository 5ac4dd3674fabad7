#include "render/fan/line_echoes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "render/simd.h"

namespace echoloop {
namespace {

/// Where in a table samples lie: cells, and how far into them. So many at once, as their values are fetched
/// before any of them is used.
struct Places {
    static constexpr int most = 128;
    std::int32_t cell[most];
    float share[most], pair[2 * most];

    ECHOLOOP_INLINE float at(int i) const { return pair[2 * i] + share[i] * (pair[2 * i + 1] - pair[2 * i]); }
};

/// A cell's ends lie side by side and are copied as one. In vectors g++ takes them apart.
#ifdef ECHOLOOP_SIMD_VERSIONS
__attribute__((optimize("no-tree-vectorize")))
#endif
void fetch(const float* values, int count, Places& places) {
    for (int i = 0; i < count; ++i)
        std::memcpy(&places.pair[2 * i], values + places.cell[i], 2 * sizeof(float));
}

/// StrengthTable::at() of every cosine, times weights where they are above 0. Cosines above 1 are cut off
/// last: else the loop does not become vectors.
ECHOLOOP_SIMD
void look_up(const float* __restrict values, const float* __restrict cosine, const float* __restrict weight,
             int count, float* __restrict amount) {
    constexpr auto last = static_cast<std::int32_t>(StrengthTable::cells - 1);
    Places places;
    for (int begin = 0; begin < count; begin += Places::most) {
        const int these = std::min(Places::most, count - begin);
        for (int i = 0; i < these; ++i) {
            const float place = cosine[begin + i] * static_cast<float>(StrengthTable::cells);
            const std::int32_t whole = static_cast<std::int32_t>(place), cell = whole < last ? whole : last;
            places.cell[i] = cell, places.share[i] = std::min(place - static_cast<float>(cell), 1.0F);
        }
        fetch(values, these, places);
        for (int i = 0; i < these; ++i) amount[begin + i] = std::max(weight[begin + i], 0.0F) * places.at(i);
    }
}

/// LobeTable::at() of each direction's sine off the axis, times weights.
ECHOLOOP_SIMD
void look_up_lobe(const float* __restrict values, std::int32_t last, float cell_width,
                  const LineDirections line, const float* __restrict weight, int count,
                  float* __restrict out) {
    Places places;
    for (int begin = 0; begin < count; begin += Places::most) {
        const int these = std::min(Places::most, count - begin);
        for (int i = 0; i < these; ++i) {
            const float y = line.top - static_cast<float>(begin + i) * line.step;
            const float place = std::abs(line.aside) / (cell_width * std::sqrt(line.ahead + y * y));
            const std::int32_t whole = static_cast<std::int32_t>(place), cell = whole < last ? whole : last;
            places.cell[i] = cell, places.share[i] = std::min(place - static_cast<float>(cell), 1.0F);
        }
        fetch(values, these, places);
        for (int i = 0; i < these; ++i) out[begin + i] = weight[begin + i] * places.at(i);
    }
}

ECHOLOOP_SIMD
void keep_weights(const float* __restrict surface, const float* __restrict weight, std::size_t count,
                  float* __restrict amount) {
    for (std::size_t i = 0; i < count; ++i)
        amount[i] = (surface[i] != 0) & (weight[i] > 0) ? weight[i] : 0.0F;
}

ECHOLOOP_SIMD
void drop_where_nothing_is(const float* __restrict surface, std::size_t count, float* __restrict amount) {
    for (std::size_t i = 0; i < count; ++i) amount[i] = surface[i] != 0 ? amount[i] : 0.0F;
}

ECHOLOOP_SIMD
void multiply_all(const float* __restrict factor, std::size_t count, float* __restrict amount) {
    for (std::size_t i = 0; i < count; ++i) amount[i] *= factor[i];
}

ECHOLOOP_SIMD
void places_of(const float* __restrict range, const float* __restrict near, const float* __restrict far,
               BinScale scale, std::size_t count, float* __restrict low, float* __restrict high,
               float* __restrict slope) {
    for (std::size_t i = 0; i < count; ++i) {
        const float from = near[i] * scale.per_metre - scale.start,
                    to = far[i] * scale.per_metre - scale.start;
        const float falls = 3 / (range[i] * scale.per_metre);
        const float steepest = 1.8F / (to - from);  // beyond, the density at the far end would be negative
        low[i] = from, high[i] = to;
        slope[i] = -std::min(falls, steepest);
    }
}

/// As bits, since ranges are positive. Where nothing is seen they are 0, which counts as the greatest number.
/// The least of each word of four pixels in a row: all of them are read, so that none need be picked out.
ECHOLOOP_SIMD
std::uint32_t nearest_bits(const Pixel* pixels, std::size_t count) {
    constexpr std::size_t at_once = 4, words = at_once * sizeof(Pixel) / sizeof(float);
    std::uint32_t least[words];
    for (std::size_t k = 0; k < words; ++k) least[k] = ~0U;
    const float* from = &pixels->range;
    const std::size_t whole = count / at_once * at_once;
    for (std::size_t i = 0; i < whole; i += at_once, from += words)
        for (std::size_t k = 0; k < words; ++k) {
            const std::uint32_t word = std::bit_cast<std::uint32_t>(from[k]) - 1;
            least[k] = word < least[k] ? word : least[k];
        }
    std::uint32_t nearest = std::min({least[0], least[words / 4], least[words / 2], least[3 * words / 4]});
    for (std::size_t i = whole; i < count; ++i)
        nearest = std::min(nearest, std::bit_cast<std::uint32_t>(pixels[i].range) - 1);
    return nearest + 1;
}

}  // namespace

void LineEchoes::resize(std::size_t samples) {
    for (auto* values : {&low, &high, &amount, &slope}) values->resize(samples);
}

void find_amounts(PixelArrays row, const float* weight, std::span<const StrengthTable* const> strength,
                  std::span<const std::uint8_t> wanted, std::size_t samples, LineEchoes& out) {
    for (std::size_t i = 0; i < samples;) {
        const std::size_t count = count_alike(row.surface + i, samples - i);
        const auto surface = static_cast<std::size_t>(row.surface[i]);
        const bool counts =
            surface > 0 && (wanted.empty() || (surface <= wanted.size() && wanted[surface - 1] != 0));
        if (counts)
            look_up(strength[surface - 1]->values().data(), row.cosine + i, weight + i,
                    static_cast<int>(count), &out.amount[i]);
        else
            std::fill_n(&out.amount[i], count, 0.0F);
        i += count;
    }
}

void find_amounts_alike(PixelArrays row, const float* weight, const StrengthTable* table, std::size_t samples,
                        LineEchoes& out) {
    if (table == nullptr) return keep_weights(row.surface, weight, samples, out.amount.data());
    look_up(table->values().data(), row.cosine, weight, static_cast<int>(samples), out.amount.data());
    drop_where_nothing_is(row.surface, samples, out.amount.data());
}

void weigh_by_lobe(const LobeTable& lobe, const LineDirections& line, const float* weight,
                   std::size_t samples, float* out) {
    look_up_lobe(lobe.values.data(), static_cast<std::int32_t>(lobe.values.size()) - 2,
                 static_cast<float>(lobe.step), line, weight, static_cast<int>(samples), out);
}

void multiply(const float* factor, std::size_t samples, float* amount) {
    multiply_all(factor, samples, amount);
}

void find_places(PixelArrays row, const Extents& extents, BinScale scale, std::size_t samples,
                 LineEchoes& out) {
    places_of(row.range, extents.near.data(), extents.far.data(), scale, samples, out.low.data(),
              out.high.data(), out.slope.data());
}

void deposit_line(LineEchoes& echoes, std::size_t samples, LineBins& bins) {
    const BinStretch covered = echoes.spreader.spread(
        {echoes.low.data(), echoes.high.data(), echoes.amount.data(), echoes.slope.data()}, samples,
        bins.size(), bins.data());
    bins.clear_but(covered.begin, covered.end);
    if (!covered.empty()) bins.look_at(covered.begin, covered.end);
}

float nearest_range(const Pixel* pixels, std::size_t samples) {
    const std::uint32_t bits = nearest_bits(pixels, samples);
    return bits != 0 ? std::bit_cast<float>(bits) : std::numeric_limits<float>::infinity();
}

}  // namespace echoloop
