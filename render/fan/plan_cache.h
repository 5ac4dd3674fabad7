// The plans of the fans that were drawn last. Never holds much more than 64 MB of them.
#pragma once

#include "render/fan/plan.h"
#include "render/recently_used.h"

namespace echoloop {

class PlanCache {
  public:
    explicit PlanCache(PlanDensity density) : density_(density) {}

    /// The plan of this geometry, made if it is not at hand. `detail`: factor on its pixels. Valid until the next
    /// call.
    const FanPlan& plan_for(const FanGeometry& geometry, double detail = 1) {
        const auto fits = [&](const Entry& entry) { return entry.detail == detail && entry.geometry == geometry; };
        const auto make = [&] {
            const PlanDensity density{density_.columns_per_beam, density_.pixels * detail};
            Entry entry{geometry, detail, plan_fan(geometry, density)};
            const std::size_t weight = bytes_of(entry.plan);
            return std::pair(std::move(entry), weight);
        };
        return plans_.get(fits, make).plan;
    }

  private:
    struct Entry {
        FanGeometry geometry;
        double detail;
        FanPlan plan;
    };
    /// Of what grows with the fan.
    static std::size_t bytes_of(const FanPlan& plan) {
        std::size_t bytes =
            sizeof(FanPlan) + plan.beams.size() * (sizeof(BeamLines) + sizeof(double)) +
            (plan.coverage.size() + plan.weight.size() + plan.line_weight.size()) * sizeof(float) +
            plan.surround.size() * sizeof(SurroundPixel) + plan.line_sector.size() * sizeof(SectorShare);
        for (const FanPart& part : plan.parts) bytes += part.far.size() * sizeof(float);
        return bytes;
    }

    PlanDensity density_;
    RecentlyUsed<Entry> plans_{64 << 20};
};

}  // namespace echoloop
