// Ground truth of a ping: the ranges that its pixels show on each beam's axis and anywhere in the beam.
#pragma once

#include <vector>

#include "render/fan/summing.h"

namespace echoloop {

/// One entry per beam.
std::vector<BeamTruth> find_truth(const Summing& summing, const BinningInput& in, const Shot& shot);

}  // namespace echoloop
