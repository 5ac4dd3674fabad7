#include "render/fan/plan_cache.h"

#include <algorithm>

namespace echoloop {
namespace {

constexpr std::size_t most_bytes = 64 << 20;

}  // namespace

PlanCache::Plan PlanCache::plan_for(const FanGeometry& geometry, const PlanDensity& density,
                                    const std::function<Plan()>& make) {
    const auto fits = [&](const Entry& entry) {
        return entry.density == density && entry.geometry == geometry;
    };
    std::promise<Plan> made;
    {
        std::unique_lock lock(mutex_);
        if (const auto entry = std::ranges::find_if(entries_, fits); entry != entries_.end()) {
            entries_.splice(entries_.begin(), entries_, entry);
            const std::shared_future<Plan> plan = entry->plan;
            lock.unlock();
            return plan.get();
        }
        entries_.push_front({geometry, density, made.get_future().share()});
    }
    try {
        Plan plan = make();
        made.set_value(plan);
        const std::lock_guard lock(mutex_);
        if (const auto entry = std::ranges::find_if(entries_, fits); entry != entries_.end())
            entry->bytes = plan->bytes;
        limit();
        return plan;
    } catch (...) {
        made.set_exception(std::current_exception());
        const std::lock_guard lock(mutex_);
        entries_.remove_if(fits);
        throw;
    }
}

void PlanCache::limit() {
    std::size_t bytes = 0;
    for (auto entry = entries_.begin(); entry != entries_.end();) {
        bytes += entry->bytes;
        entry = bytes > most_bytes && entry != entries_.begin() ? entries_.erase(entry) : std::next(entry);
    }
}

}  // namespace echoloop
