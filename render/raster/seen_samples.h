// What samples show of the triangle that is nearest there, in the widest vectors of the processor. Knows no
// pixels.
#pragma once

#include <array>

namespace echoloop::raster {

/// Of one triangle: its numbers as ViewPainter::Shown begins, the normals and surfaces of its corners.
struct Along {
    float numbers[12], normals[9], surfaces[3], side, x;
};

/// What it shows at neighbouring samples of a line.
void look_along(const Along& triangle, const float* y_of, int count, float* depth, float* nx, float* ny,
                float* nz, float* px, float* py, float* pz, float* surface, float* lean);

/// The same for SeenCorners::bow(), which is given at its corners.
void bow_along(const Along& triangle, float b0, float b1, float b2, const float* y_of, int count, float* bow);

}  // namespace echoloop::raster
