#include "render/fan/spreads.h"

#include <algorithm>
#include <cmath>

#include "render/simd.h"

namespace echoloop {
namespace {

constexpr float straight =
    0.05F;  ///< change of a step in 1 / R, relative to the step, that is still a plane's

ECHOLOOP_SIMD
void spread_planes(const PixelArrays row, const EchoSpread spread, int count, float* __restrict half) {
    for (int i = 0; i < count; ++i) half[i] = spread.half(row.footprint[i], row.range[i]);
}

/// 1 where an outline lies between the samples i - step and i: they and their neighbours do not show one
/// plane, and their ranges differ as on no plane. `step`: samples that a usual pixel is high. `inverse`: 1/m,
/// with 2 `step` zeros on both sides. `least`: m, a difference that does not matter. A surface that ends
/// beyond `end` goes on.
ECHOLOOP_SIMD
void find_outlines(const float* __restrict range, const float* __restrict footprint,
                   const float* __restrict inverse, int step, int count, float least, float end,
                   float* __restrict outline) {
    for (int i = step; i < count; ++i) {
        const float first = inverse[i - 2 * step], upper = inverse[i - step], lower = inverse[i],
                    last = inverse[i + step];
        const float change = lower - upper, size = std::abs(change);
        const float before = first != 0 ? upper - first : change, after = last != 0 ? last - lower : change;
        const float turn = std::max(std::abs(before - change), std::abs(after - change));
        const float upper_size = std::abs(footprint[i - step]), lower_size = std::abs(footprint[i]);
        const float steepest = std::min(upper_size * upper * upper, lower_size * lower * lower);
        const float difference = std::abs(range[i] - range[i - step]);
        const float jump = 3 * std::max(upper_size, lower_size) + 0.01F;
        // By selection: conditions that are joined do not become vectors.
        const float bent = turn < straight * size ? 0.0F : 1.0F,
                    steep = size < 1.25F * steepest ? bent : 1.0F;
        const float unlike = difference < least ? 0.0F : steep, both = difference > jump ? unlike : 0.0F;
        const float one = std::max(range[i], range[i - step]) >= end ? 0.0F : 1.0F;
        const float with_upper = lower != 0 ? both : one, without_upper = lower != 0 ? one : 0.0F;
        outline[i] = upper != 0 ? with_upper : without_upper;
    }
}

/// Keeps the echo of samples beside outlines on their own side. `outline`: with `step` zeros at the end.
ECHOLOOP_SIMD
void keep_beside(const float* __restrict outline, const float* __restrict footprint, int step, int count,
                 float* __restrict half) {
    constexpr float beside = 0.1F;  // usual pixels; less would fall into single bins
    for (int i = 0; i < count; ++i) {
        const float least = std::min(half[i], beside * std::abs(footprint[i]));
        half[i] = outline[i] + outline[i + step] > 0 ? least : half[i];
    }
}

/// 1 / R changes by the same on both sides of a sample.
ECHOLOOP_SIMD
void find_ends(const float* __restrict range, const float* __restrict half, int count, float* __restrict near,
               float* __restrict far) {
    for (int i = 0; i < count; ++i) {
        const float r = range[i], square = r * r, h = half[i];
        near[i] = square / (r + h), far[i] = square / (r - h);
    }
}

}  // namespace

void find_spreads(const PixelRow& row, const View& view, float bin_length, float end, Extents& out) {
    static thread_local std::vector<float> half, inverse, outlines;
    for (auto* values : {&half, &out.near, &out.far}) values->resize(view.samples);
    const int count = static_cast<int>(view.samples);
    spread_planes(row.arrays(), EchoSpread(view), count, half.data());
    if (view.sharp_outlines) {
        const auto step = static_cast<std::size_t>(view.usual_height);
        inverse.assign(view.samples + 4 * step, 0.0F), outlines.assign(view.samples + step, 0.0F);
        std::copy_n(row.arrays().inverse, view.samples, inverse.data() + 2 * step);
        find_outlines(row.range(), row.footprint(), inverse.data() + 2 * step, static_cast<int>(step), count,
                      0.25F * bin_length, end, outlines.data());
        keep_beside(outlines.data(), row.footprint(), static_cast<int>(step), count, half.data());
    }
    find_ends(row.range(), half.data(), count, out.near.data(), out.far.data());
}

}  // namespace echoloop
