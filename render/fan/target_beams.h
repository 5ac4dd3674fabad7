// Which beams hear a target, and how loud. Knows no scene.
#pragma once

#include <span>
#include <vector>

#include "render/acoustics/chain.h"
#include "render/fan/plan.h"
#include "render/paths/paths.h"
#include "render/recently_used.h"

namespace echoloop {

/// Keeps the patterns of the last fans, as tables over the sine of the angle off a beam's axis.
class TargetBeams {
  public:
    TargetBeams();
    ~TargetBeams();

    /// One point echo per beam and path that is heard, beam by beam. A single beam's pattern is in the echoes
    /// already; a fan's beams weigh them by their bearing, within 0.02 dB of the pattern's formula where that
    /// is above -40 dB.
    std::vector<PointEcho> points_of(const FanPlan& plan, std::span<const TargetEcho> targets);

  private:
    class Known;
    RecentlyUsed<Known> known_;
    std::vector<float> weights_;  ///< scratch: of all beams, target by target
};

}  // namespace echoloop
