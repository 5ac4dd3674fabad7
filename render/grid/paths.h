// Which beams of a grid hear echoes that the rasteriser cannot see, and how loud. Finds no path and knows no
// scene.
#pragma once

#include "render/acoustics/chain.h"
#include "render/grid/binning.h"
#include "render/grid/lobes.h"
#include "render/paths/paths.h"

namespace echoloop {

/// What beams hear: diffuse echoes, and those of targets and corners.
struct GridPaths {
    std::vector<Arrival> arrivals;
    std::vector<PointEcho> points;
};

GridPaths share_paths(const PathEchoes& echoes, const GridPlan& plan, const GridGeometry& geometry,
                      const GridLobes& lobes);

}  // namespace echoloop
