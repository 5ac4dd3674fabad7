// Ground truth of a ping: the ranges that its pixels show on each beam's axis and anywhere in the beam.
#pragma once

#include <span>
#include <vector>

#include "render/fan/binning.h"

namespace echoloop {

/// m, of what stands in a direction relative to the plan's level plane; NaN: nothing.
float axis_range(const FanPlan& plan, std::span<const Pixel> pixels, double bearing, double elevation,
                 PixelOffset offset);

/// One entry per bearing. `offset` is where in its pixels the ping sampled.
std::vector<BeamTruth> find_truth(const FanPlan& plan, std::span<const Pixel> pixels,
                                  std::span<const double> bearings, PixelOffset offset);

}  // namespace echoloop
