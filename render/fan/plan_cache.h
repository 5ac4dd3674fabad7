// The plans that were drawn last, of fans and of rows of beams, for several renderers. Never holds much more
// than 64 MB of them.
#pragma once

#include <functional>
#include <future>
#include <list>
#include <memory>
#include <mutex>

#include "render/fan/plan.h"

namespace echoloop {

/// May be used by several threads at once.
class PlanCache {
  public:
    using Plan = std::shared_ptr<const FanPlan>;

    /// The plan of this geometry; make() if it is not at hand: once, however many ask for it meanwhile.
    Plan plan_for(const FanGeometry& geometry, const PlanDensity& density, const std::function<Plan()>& make);

  private:
    struct Entry {
        FanGeometry geometry;
        PlanDensity density;
        std::shared_future<Plan> plan;
        std::size_t bytes = 0;  ///< once it is made
    };

    /// Drops what was used least recently.
    void limit();

    std::mutex mutex_;
    std::list<Entry> entries_;  ///< last used first, under mutex_
};

}  // namespace echoloop
