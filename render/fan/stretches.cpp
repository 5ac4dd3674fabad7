#include "render/fan/stretches.h"

#include <algorithm>
#include <cmath>

#include "render/simd.h"

namespace echoloop {
namespace {

/// Samples beside a bend over which weight goes from the samples to the stretches between them: the faster,
/// the more it would matter to the mean where that begins.
constexpr int fade = 6;
constexpr float straight =
    0.05F;  ///< change of a step in 1 / R, relative to the step, that is still a plane's

/// Where in a line, counted in pixels, weight begins and ends.
struct Covered {
    float first, last;
};

Covered covered_by(const float* coverage, std::size_t count) {
    std::size_t first = 0, last = count;
    while (first < count && coverage[first] == 0) ++first;
    while (last > first && coverage[last - 1] == 0) --last;
    if (first == last) return {0, 0};
    return {static_cast<float>(first) + 1 - coverage[first],
            static_cast<float>(last) - 1 + coverage[last - 1]};
}

/// 1 where the samples i - 1 and i and their neighbours do not show one plane. `least`: m, a step that does
/// not matter. A surface that ends beyond `end` goes on.
ECHOLOOP_SIMD
void find_bends(const PixelArrays row, int count, float least, float end, float* __restrict bend) {
    const float *range = row.range, *footprint = row.footprint, *inverse = row.inverse;
    for (int i = 1; i < count; ++i) {
        const float first = inverse[i - 2], upper = inverse[i - 1], lower = inverse[i], last = inverse[i + 1];
        const float change = lower - upper, size = std::abs(change);
        const float before = first != 0 ? upper - first : change, after = last != 0 ? last - lower : change;
        const float turn = std::max(std::abs(before - change), std::abs(after - change));
        const float upper_plane = std::abs(footprint[i - 1]) * upper * upper;
        const float lower_plane = std::abs(footprint[i]) * lower * lower;
        const bool plane = (turn < straight * size) & (size < 1.25F * std::min(upper_plane, lower_plane));
        const bool small = std::abs(range[i] - range[i - 1]) < least;
        const bool both = (upper != 0) & (lower != 0), none = (upper == 0) & (lower == 0);
        const bool beyond = std::max(range[i], range[i - 1]) >= end;
        bend[i] = none | (both ? small | plane : beyond) ? 0.0F : 1.0F;
    }
}

/// From bends to the share of each sample that stays where it was sampled.
ECHOLOOP_SIMD
void find_held(const float* __restrict bend, int count, float* __restrict held) {
    for (int i = 0; i < count; ++i) {
        float share = 0;
        for (int k = 0; k < fade; ++k)
            share =
                std::max(share, (1 - static_cast<float>(k) / fade) * std::max(bend[i - k], bend[i + 1 + k]));
        held[i] = share;
    }
}

/// m, change of range over what a sample stands for: across lines, where that is most of its change, and
/// along its line.
ECHOLOOP_SIMD
void find_widths(const PixelArrays row, const PixelArrays before, const PixelArrays after, int count,
                 float* __restrict across, float* __restrict half_along) {
    for (int i = 0; i < count; ++i) {
        const float size = std::abs(row.footprint[i]), r = row.range[i];
        const float line = range_step(before, row, after, i);
        const float sample =
            range_step(row.range[i - 1], row.surface[i - 1], r, row.range[i + 1], row.surface[i + 1], size);
        across[i] = row.footprint[i] < 0 ? std::abs(line) : 0.0F;
        half_along[i] = 0.5F * std::sqrt(sample * sample + line * line);
    }
}

/// Of samples, each with a neighbour at both ends.
struct Shares {
    const float *density, *held, *across;
};

ECHOLOOP_SIMD
void find_ranges(const float* __restrict inverse, const Shares samples, Covered covered, float offset,
                 int count, float* __restrict near, float* __restrict middle, float* __restrict far,
                 float* __restrict of_upper, float* __restrict of_lower) {
    for (int i = 0; i <= count; ++i) {
        const auto edge = static_cast<float>(i);
        const float sample = edge - 0.5F + offset;  // the upper one
        const float from = std::max(sample, covered.first), to = std::min(sample + 1, covered.last);
        const float begin = from - sample, end = to - sample, a = inverse[i - 1], b = inverse[i];
        const float start = a != 0 ? a : b,
                    change = (b != 0 ? b : a) - start;  // beside nothing a range is all there is
        const float first = 1 / (start + change * begin), last = 1 / (start + change * end);
        const float centre = 1 / (start + change * (0.5F * (begin + end)));
        const float across = 0.5F * (samples.across[i - 1] + samples.across[i]), along = last - first;
        const float half = 0.5F * std::sqrt(along * along + across * across);
        near[i] = across > 0 ? centre - half : std::min(first, last);
        far[i] = across > 0 ? centre + half : std::max(first, last);
        middle[i] = centre;
        const float upper = std::max(std::min(edge, covered.last) - from, 0.0F) * samples.density[i - 1];
        const float lower = std::max(to - std::max(edge, covered.first), 0.0F) * samples.density[i];
        of_upper[i] = a != 0 ? upper * (1 - samples.held[i - 1]) : 0.0F;
        of_lower[i] = b != 0 ? lower * (1 - samples.held[i]) : 0.0F;
    }
}

ECHOLOOP_SIMD
void find_kept(const float* __restrict inverse, const float* __restrict weight, const float* __restrict held,
               int count, float* __restrict at_sample) {
    for (int i = 0; i < count; ++i) {
        const float kept = held[i] * weight[i];
        at_sample[i] = inverse[i] != 0 ? kept : 0.0F;
    }
}

}  // namespace

void find_stretches(const PixelRow& before, const PixelRow& row, const PixelRow& after, const float* coverage,
                    const float* weight, PixelOffset offset, std::size_t count, float bin_length, float end,
                    Stretches& out) {
    for (auto* values : {&out.near, &out.middle, &out.far, &out.of_upper, &out.of_lower})
        values->resize(count + 1);
    for (auto* values : {&out.at_sample, &out.half_width}) values->resize(count);
    static thread_local std::vector<float> density, held, across, bends, nothing;
    for (auto* values : {&density, &held, &across}) values->assign(count + 2, 0.0F);
    bends.assign(count + 1 + 2 * fade, 0.0F);
    nothing.assign(count, 0.0F);
    for (std::size_t i = 0; i < count; ++i) density[i + 1] = coverage[i] > 0 ? weight[i] / coverage[i] : 0;
    const int samples = static_cast<int>(count);
    find_bends(row.arrays(), samples, 0.25F * bin_length, end, bends.data() + fade);
    find_held(bends.data() + fade, samples, held.data() + 1);
    const auto neighbour = [&](const PixelRow& other) {
        PixelArrays arrays = other.arrays();
        if (&other == &row) arrays.surface = nothing.data();  // a view's edge tells no step
        return arrays;
    };
    find_widths(row.arrays(), neighbour(before), neighbour(after), samples, across.data() + 1,
                out.half_width.data());
    for (auto* values : {&held, &across}) values->front() = (*values)[1], values->back() = (*values)[count];
    find_ranges(row.arrays().inverse, {density.data() + 1, held.data() + 1, across.data() + 1},
                covered_by(coverage, count), static_cast<float>(offset.sample), samples, out.near.data(),
                out.middle.data(), out.far.data(), out.of_upper.data(), out.of_lower.data());
    find_kept(row.arrays().inverse, weight, held.data() + 1, samples, out.at_sample.data());
}

}  // namespace echoloop
