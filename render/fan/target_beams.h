// Which beams hear a target, and how loud. Knows no scene.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "render/acoustics/chain.h"
#include "render/fan/plan.h"
#include "render/paths/paths.h"

namespace echoloop {

/// Keeps the pattern of the last fan: to make it anew took 5 % of a ping that hears mirrors.
class TargetBeams {
  public:
    TargetBeams();
    ~TargetBeams();

    /// One point echo per beam and path that is heard. A single beam's pattern is in the echoes already; a
    /// fan's beams weigh them by their bearing.
    std::vector<PointEcho> points_of(const FanPlan& plan, std::span<const TargetEcho> targets);

  private:
    struct Known;
    std::unique_ptr<Known> known_;
};

}  // namespace echoloop
