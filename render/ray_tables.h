// The tables of bent rays that one renderer has needed of late. Knows no scene.
#pragma once

#include <cmath>
#include <memory>

#include "render/ray_table.h"
#include "render/recently_used.h"

namespace echoloop {

/// m: tables are made for depths in steps of a decimetre. What a sonar is off from its step, at most 5 cm,
/// the whole profile is shifted by.
inline double depth_step(double depth) { return std::max(0.0, std::round(10 * depth) / 10); }

class RayTables {
  public:
    /// That of a sonar `depth` m deep for ranges up to `range` m, or somewhat farther.
    std::shared_ptr<const RayTable> of(std::span<const SoundSpeedPoint> profile, double depth, double range,
                                       bool surface) {
        const double step = depth_step(depth),
                     reach = std::exp2(std::ceil(4 * std::log2(1.02 * std::max(range, 0.1))) / 4);
        return tables_.get(
            [&](const auto& known) { return known->depth() == step && known->range() == reach; },
            [&] {
                return std::pair(std::make_shared<const RayTable>(profile, step, reach, surface),
                                 std::size_t{1});
            });
    }

    /// That of a depth at most half a metre off, for what need not be made anew in every decimetre.
    std::shared_ptr<const RayTable> nearby(std::span<const SoundSpeedPoint> profile, double depth,
                                           double range, bool surface) {
        return of(profile, std::round(depth), range, surface);
    }

  private:
    RecentlyUsed<std::shared_ptr<const RayTable>> tables_{24};
};

}  // namespace echoloop
