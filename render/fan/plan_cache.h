// The plans of the fans that were drawn last, so that several devices can share a renderer. Never holds more
// than a few.
#pragma once

#include <cstddef>
#include <list>

#include "render/fan/plan.h"

namespace echoloop {

class PlanCache {
  public:
    explicit PlanCache(PlanDensity density) : density_(density) {}

    /// The plan of this geometry, made if it is not at hand. Valid until the next call.
    const FanPlan& plan_for(const FanGeometry& geometry) {
        for (auto entry = entries_.begin(); entry != entries_.end(); ++entry)
            if (entry->geometry == geometry) {
                entries_.splice(entries_.begin(), entries_, entry);
                return entries_.front().plan;
            }
        if (entries_.size() == most) entries_.pop_back();
        entries_.push_front({geometry, plan_fan(geometry, density_)});
        return entries_.front().plan;
    }

  private:
    static constexpr std::size_t most = 8;
    struct Entry {
        FanGeometry geometry;
        FanPlan plan;
    };
    PlanDensity density_;
    std::list<Entry> entries_;  ///< last used first
};

}  // namespace echoloop
