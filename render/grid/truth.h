// Ground truth of a grid's ping, as find_truth() of a fan.
#pragma once

#include "render/fan/binning.h"
#include "render/grid/plan.h"

namespace echoloop {

/// One entry per beam. `in.plan` is `plan.drawing`.
std::vector<BeamTruth> find_grid_truth(const BinningInput& in, const GridPlan& plan, const Shot& shot);

}  // namespace echoloop
