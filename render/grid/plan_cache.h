// The plans of the grids that were drawn last. Never holds much more than 64 MB of them.
#pragma once

#include "render/grid/lobes.h"
#include "render/grid/plan.h"
#include "render/recently_used.h"

namespace echoloop {

struct GridEntry {
    GridGeometry geometry;
    double detail;
    GridPlan plan;
    GridLobes lobes;
};

class GridCache {
  public:
    explicit GridCache(PlanDensity density) : density_(density) {}

    /// As PlanCache::plan_for().
    const GridEntry& entry_for(const GridGeometry& geometry, double detail) {
        const auto fits = [&](const GridEntry& entry) {
            return entry.detail == detail && entry.geometry == geometry;
        };
        const auto make = [&] {
            const PlanDensity density{density_.columns_per_beam, density_.pixels * detail};
            GridEntry entry{geometry, detail, plan_grid(geometry, density), GridLobes(geometry.row)};
            const std::size_t weight = entry.plan.bytes();
            return std::pair(std::move(entry), weight);
        };
        return entries_.get(fits, make);
    }

  private:
    PlanDensity density_;
    RecentlyUsed<GridEntry> entries_{64 << 20};
};

}  // namespace echoloop
