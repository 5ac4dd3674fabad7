// Which beams of a grid hear echoes that the rasteriser cannot see, and how loud. Finds no path and knows no
// scene.
#pragma once

#include "render/acoustics/chain.h"
#include "render/grid/plan.h"
#include "render/paths/paths.h"

namespace echoloop {

/// An echo of complete power that arrives along a beam.
struct Arrival {
    std::size_t beam;
    float near_range, far_range, power;  ///< m, m, uPa^2
};

/// Of diffuse echoes.
std::vector<Arrival> arrivals_of(const GridPlan& plan, std::span<const PathEcho> echoes);
/// Of targets and corners.
std::vector<PointEcho> points_of(const GridPlan& plan, std::span<const TargetEcho> echoes);

}  // namespace echoloop
