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

/// 1 where an outline lies between the samples i - 1 and i: a bend with a step that no plane has.
ECHOLOOP_SIMD
void find_outlines(const PixelArrays row, float usual_height, int count, const float* __restrict bend,
                   float* __restrict outline) {
    for (int i = 1; i < count; ++i) {
        const float plane = std::max(std::abs(row.footprint[i]), std::abs(row.footprint[i - 1]));
        const bool step = std::abs(row.range[i] - row.range[i - 1]) > 3 * usual_height * plane + 0.01F;
        const bool nothing = (row.inverse[i] == 0) | (row.inverse[i - 1] == 0);
        outline[i] = nothing | step ? bend[i] : 0.0F;
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

/// m, change of range over what a sample stands for: across lines, where that is most of its change, and half
/// of the greater one.
ECHOLOOP_SIMD
void find_widths(const PixelArrays row, const EchoSpread spread, int count, float* __restrict across,
                 float* __restrict half_width) {
    for (int i = 0; i < count; ++i) {
        const float half = spread.half(row.footprint[i], row.range[i]);
        across[i] = row.footprint[i] < 0 ? 2 * half : 0.0F;
        half_width[i] = half;
    }
}

/// Keeps the echo of samples on their own side of outlines. `near`: 1 beside one, less the farther away, as
/// find_held() makes it.
ECHOLOOP_SIMD
void keep_beside(const float* __restrict near, const float* __restrict footprint, int count,
                 float* __restrict half_width) {
    constexpr float beside = 0.1F;  // pixels; less would fall into single bins
    for (int i = 0; i < count; ++i) {
        const float away = std::max((1 - near[i]) * fade, beside);
        half_width[i] = near[i] > 0 ? std::min(half_width[i], away * std::abs(footprint[i])) : half_width[i];
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

void find_stretches(const PixelRow& row, const View& view, const float* coverage, const float* weight,
                    PixelOffset offset, float bin_length, float end, Stretches& out) {
    const std::size_t count = view.samples;
    for (auto* values : {&out.near, &out.middle, &out.far, &out.of_upper, &out.of_lower})
        values->resize(count + 1);
    for (auto* values : {&out.at_sample, &out.half_width}) values->resize(count);
    static thread_local std::vector<float> density, held, across, bends;
    for (auto* values : {&density, &held, &across}) values->assign(count + 2, 0.0F);
    bends.assign(count + 1 + 2 * fade, 0.0F);
    for (std::size_t i = 0; i < count; ++i) density[i + 1] = coverage[i] > 0 ? weight[i] / coverage[i] : 0;
    const int samples = static_cast<int>(count);
    find_bends(row.arrays(), samples, 0.25F * bin_length, end, bends.data() + fade);
    find_held(bends.data() + fade, samples, held.data() + 1);
    find_widths(row.arrays(), EchoSpread(view), samples, across.data() + 1, out.half_width.data());
    if (view.sharp_outlines) {
        static thread_local std::vector<float> outlines, near;
        outlines.assign(bends.size(), 0.0F), near.resize(count);
        find_outlines(row.arrays(), static_cast<float>(view.usual_height), samples, bends.data() + fade,
                      outlines.data() + fade);
        find_held(outlines.data() + fade, samples, near.data());
        keep_beside(near.data(), row.footprint(), samples, out.half_width.data());
    }
    for (auto* values : {&held, &across}) values->front() = (*values)[1], values->back() = (*values)[count];
    find_ranges(row.arrays().inverse, {density.data() + 1, held.data() + 1, across.data() + 1},
                covered_by(coverage, count), static_cast<float>(offset.sample), samples, out.near.data(),
                out.middle.data(), out.far.data(), out.of_upper.data(), out.of_lower.data());
    find_kept(row.arrays().inverse, weight, held.data() + 1, samples, out.at_sample.data());
}

}  // namespace echoloop
