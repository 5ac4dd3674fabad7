// The stretch of range that each whole pixel of a line stands for, wherever in it a ping sampled. Keeps to
// the pixel: it never smooths across an edge.
#pragma once

#include <vector>

#include "render/fan/pixel_rows.h"

namespace echoloop {

/// m, on the surfaces' planes, one per pixel.
struct PixelExtents {
    std::vector<float> near, middle, far;
    void resize(std::size_t count);
};

/// The ping sampled somewhere in the pixel; the extent is that of the whole pixel (at the fan's upper and
/// lower edge of its covered part), so a smooth surface sounds the same wherever the samples fall.
///
/// The plane of a facet may reach much farther than the facet, as on the crest of a ripple, so a footprint
/// goes at most half as far again as the step to the nearer neighbour. On a smooth surface that never binds.
/// On a plane at grazing incidence 1 / R is linear in the angle, and elsewhere the steps are too small to
/// matter.
///
/// With `both_ways` a pixel's range changes along its line and across lines alike, as in square pixels: the
/// extent then has the variance of both together. Else only the greater change counts: lines are narrow.
///
/// `before` and `after` are the lines on both sides, at a view's edge the line itself. Pixels without a
/// surface get meaningless extents.
void find_pixel_extents(const PixelRow& before, const PixelRow& row, const PixelRow& after,
                        const float* coverage, PixelOffset offset, std::size_t count, bool both_ways,
                        PixelExtents& extents);

}  // namespace echoloop
