// How fast what a beam hears comes nearer, and how echoes by way of a mirror move with the sonar.
#pragma once

#include <vector>

#include "render/fan/ping_motion.h"
#include "render/fan/summing.h"

namespace echoloop {

/// One for each of the beams' bins: moments of the closing speeds, weighed by the power of what comes
/// straight back. Sums twice more.
std::vector<ClosingSpeed> closing_speeds(Summing& summing, BinningInput in);

/// Moves echoes to the ranges at which they appear. The sonar's own motion counts, where they arrive: that of
/// what else moves does not.
void shift_paths(const PingMotion& motion, PathEchoes& paths);

}  // namespace echoloop
