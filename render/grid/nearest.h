// Ground truth of a grid's ping: the nearest range in each beam.
#pragma once

#include <span>

#include "render/fan/binning.h"
#include "render/grid/plan.h"

namespace echoloop {

/// As Summing::find_nearest(). `in.plan` is `plan`.
void find_nearest_of_grid(const BinningInput& in, const GridPlan& plan, std::span<BeamTruth> truth);

}  // namespace echoloop
