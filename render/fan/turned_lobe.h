// The pattern across a fan of an array that receives where it has turned to. Knows no range and no pixels.
#pragma once

#include <span>
#include <vector>

#include "render/fan/plan.h"

namespace echoloop {

class TurnedLobe {
  public:
    TurnedLobe() = default;
    /// `plan`: of beams that are no boxes, and not alone.
    explicit TurnedLobe(const FanPlan& plan);

    /// The two-way power with which a beam hears each of these directions: by its pattern `turned` rad
    /// farther off, and by the one that it sent with where it sends as it receives.
    void weigh(std::span<const float> bearings, float beam, float turned, std::vector<float>& weights) const;

  private:
    bool both_ways_ = false;
    float first_ = 0, per_step_ = 0;  ///< rad, 1 / rad
    std::vector<float> values_;       ///< of one way where the beam is directive both ways
};

}  // namespace echoloop
