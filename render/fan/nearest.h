// Ground truth of a fan's ping: the nearest range in each beam.
#pragma once

#include <span>

#include "render/fan/binning.h"

namespace echoloop {

/// As Summing::find_nearest().
void find_nearest_of_fan(const BinningInput& in, std::span<BeamTruth> truth);

}  // namespace echoloop
