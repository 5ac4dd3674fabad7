// Ground truth of a grid's ping: which object most of each bin's direct echo comes from, as ObjectFinder of
// fans. Costs a pass over the pixels for each object in sight, so it is made for who asks only.
#pragma once

#include "render/fan/binning.h"
#include "render/grid/plan.h"

namespace echoloop {

/// Fills `objects` (beams x bins, as Echogram::objects). `object_of_surface`: index in Scene::objects() of
/// every surface index. Bins with less power than `least` (uPa^2, of all echoes that arrive within the bin)
/// are 0.
void find_grid_objects(BinningInput in, const GridPlan& plan,
                       std::span<const std::uint32_t> object_of_surface, double least,
                       std::vector<std::uint16_t>& objects);

}  // namespace echoloop
