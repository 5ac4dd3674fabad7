// Renderers that share their plans: each is made once, and what was not used for long is forgotten.
#include "render/fan/plan_cache.h"

#include <gtest/gtest.h>

#include <latch>
#include <thread>
#include <vector>

#include "tests/render/shots.h"

namespace echoloop {
namespace {

PlanCache::Plan plan_for(PlanCache& cache, const FanGeometry& geometry, const PlanDensity& density = {}) {
    return cache.plan_for(geometry, density,
                          [&] { return std::make_shared<const FanPlan>(plan_fan(geometry, density)); });
}

TEST(PlanCache, MakesAPlanOnceForAllWhoAskAtTheSameTime) {
    PlanCache cache;
    const FanGeometry geometry = geometry_of(test::forward_looking(), Effects{});
    std::vector<PlanCache::Plan> plans(4);
    std::vector<std::thread> threads;
    std::latch all(4);
    for (auto& plan : plans)
        threads.emplace_back([&] {
            all.arrive_and_wait();
            plan = plan_for(cache, geometry);
        });
    for (auto& thread : threads) thread.join();
    for (const auto& plan : plans) EXPECT_EQ(plan, plans[0]);
    EXPECT_EQ(plan_for(cache, geometry), plans[0]);
    EXPECT_NE(plan_for(cache, geometry, {1.5, 0.25}), plans[0]) << "another detail";
    Shot other = test::forward_looking();
    other.fan_height *= 0.9;
    EXPECT_NE(plan_for(cache, geometry_of(other, Effects{})), plans[0]) << "another fan";
}

TEST(PlanCache, ForgetsWhatWasNotUsedForLong) {
    PlanCache cache;
    Shot shot = test::fan(120, 20, 512, 1000, 100);
    const FanGeometry first = geometry_of(shot, Effects::none());
    const std::weak_ptr<const FanPlan> plan = plan_for(cache, first);
    int plans = 0;
    for (; !plan.expired() && plans < 500; ++plans) {
        shot.fan_height *= 0.999;
        plan_for(cache, geometry_of(shot, Effects::none()));
    }
    EXPECT_GT(plans, 10);
    EXPECT_LT(plans, 500);
}

}  // namespace
}  // namespace echoloop
