// What beams of a fan that send as they receive have in common with themselves when the receiver has turned.
// Where only the receiver forms beams, that is all they hear, elsewhere. Knows no pixels.
#pragma once

#include "render/fan/plan.h"

namespace echoloop {

struct BinningInput;
class LineSums;
class Lobe;

/// Fills FanPlan::common_ahead and common_far. Lobes that are far off the axis fit each other again and again
/// as they are shifted, and are taken for those 12 to 24 beam widths off it.
void find_common_lobes(FanPlan& plan, const FanGeometry& geometry, const Lobe& lobe);

/// Of the far lobes, what floats in the water around: it is everywhere, so it is heard where it was sent.
/// `sums`: the surround's alone.
void turn_water_around(const BinningInput& in, LineSums& sums);

}  // namespace echoloop
