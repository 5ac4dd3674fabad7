// What coarse pixels in the far lobes hear of a ping whose receiver turns meanwhile. Knows no bins.
#pragma once

#include <cstddef>

#include "render/fan/plan.h"

namespace echoloop {

struct BinningInput;

/// `power`: two-way, over the sine. `width`: of the sine, over which a pixel takes the mean; `spacing`: of
/// the pattern's nulls, over the sine.
SmoothLobe smooth_lobe(const LobeTable& power, int ways, double width, double spacing);

/// By how much the echo of a surround pixel changes when it comes back to a receiver that has turned.
struct Turned {
    float kept = 1;       ///< of its power
    float sectors = 0;    ///< spacings of sectors, from where it was sent to where it is heard
    bool inside = false;  ///< it is heard from where the level views look, though it was sent beside
};

/// One line of a surround view. A direction d is seen at d - w x d by a receiver that has turned by w.
class TurnedSurround {
  public:
    /// Where nothing turns, at() must not be asked.
    TurnedSurround(const BinningInput& in, const View& view, std::size_t line);
    bool turns() const { return turns_; }
    /// `sector`: the place among the sectors at which the pixel was sent to; `range` in m.
    Turned at(std::size_t sample, float range, float sector) const;

  private:
    bool turns_ = false;
    const FanPlan* plan_ = nullptr;
    Vec3 level_, up_, per_range_;  ///< of the array's frame; rad per m
    double top_ = 0, step_ = 0;
    double first_sector_ = 0, last_sector_ = 0;  ///< between which level views look
};

}  // namespace echoloop
