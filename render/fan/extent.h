// The stretch of range that one pixel stands for, from its footprint, its neighbours and where in it the ping
// sampled. Keeps to the pixel: it never smooths across an edge.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "render/fan/binning.h"

namespace echoloop {

/// The pixels of one line, with the lines on both sides (at a view's edge the line itself).
struct PixelLine {
    std::size_t samples = 0;
    const Pixel *pixels = nullptr, *before = nullptr, *after = nullptr;
    const float* coverage = nullptr;  ///< share of each pixel within the fan's height
    PixelOffset offset;
};

/// m, on the surface's plane: the middle of the pixel, and its nearer and farther edge.
struct Extent {
    float middle, near, far;
};

/// Change of range from one pixel to the next along a line or across lines; 0 where no neighbour tells its
/// sign.
///
/// The plane of a facet may reach much farther than the facet, as on the crest of a ripple, so a footprint
/// goes at most half as far again as the step to the nearer neighbour. On a smooth surface that never binds.
inline float range_step(const Pixel& previous, const Pixel& pixel, const Pixel& next, float footprint) {
    constexpr float none = std::numeric_limits<float>::infinity();
    const bool no_previous = previous.surface == 0 || &previous == &pixel,
               no_next = next.surface == 0 || &next == &pixel;
    const float from_previous = no_previous ? none : pixel.range - previous.range;
    const float to_next = no_next ? none : next.range - pixel.range;
    const float nearer = std::abs(from_previous) < std::abs(to_next) ? from_previous : to_next;
    return std::copysign(std::min(footprint, 1.5F * std::abs(nearer)), nearer);
}

/// The extent from `begin` to `end`, in pixels from the sample point, where range changes by `step` per
/// pixel: on a plane at grazing incidence 1 / R is linear in the angle, and elsewhere the steps are too small
/// to matter.
inline Extent extent_between(float range, float step, float begin, float end) {
    const auto at = [range, step](float pixels) { return range * range / (range - step * pixels); };
    const float first = at(begin), last = at(end);
    return {at(0.5F * (begin + end)), std::min(first, last), std::max(first, last)};
}

/// The ping sampled somewhere in the pixel; the extent is that of the whole pixel (at the fan's upper and
/// lower edge of its covered part), so a smooth surface sounds the same wherever the samples fall.
inline Extent extent_of(const PixelLine& line, std::size_t i) {
    const Pixel& pixel = line.pixels[i];
    if (pixel.footprint < 0) {
        const float step = range_step(line.before[i], pixel, line.after[i], -pixel.footprint);
        const auto middle = -static_cast<float>(line.offset.line);
        return extent_between(pixel.range, step, middle - 0.5F, middle + 0.5F);
    }
    const Pixel& upper = line.pixels[i > 0 ? i - 1 : i];
    const Pixel& lower = line.pixels[i + 1 < line.samples ? i + 1 : i];
    const float step = range_step(upper, pixel, lower, pixel.footprint), hidden = 1 - line.coverage[i];
    const auto middle = -static_cast<float>(line.offset.sample);
    const bool upper_edge = i < line.samples / 2;
    return extent_between(pixel.range, step, middle - 0.5F + (upper_edge ? hidden : 0),
                          middle + 0.5F - (upper_edge ? 0 : hidden));
}

}  // namespace echoloop
