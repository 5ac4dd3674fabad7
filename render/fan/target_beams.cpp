#include "render/fan/target_beams.h"

#include <cmath>

#include "render/fan/plan_parts.h"

namespace echoloop {

std::vector<PointEcho> points_of(const FanPlan& plan, std::span<const TargetEcho> targets) {
    constexpr double least = 1e-8;  // of the axis, two ways: not heard
    std::vector<PointEcho> points;
    if (targets.empty()) return points;
    const FanGeometry& fan = plan.geometry;
    const FanLobes lobes(fan, plan.errors);
    const auto heard = [&](double off, double turned) {
        const double back = lobes.horizontal.power(off);
        if (turned == 0 || fan.horizontal.ways != 2) return back;
        return std::sqrt(back * lobes.horizontal.power(off - turned));
    };
    for (const TargetEcho& target : targets)
        for (std::size_t beam = 0; beam < fan.bearings.size(); ++beam) {
            const double off = target.bearing - fan.bearings[beam];
            const bool aside = !fan.side_lobes && std::abs(off) > lobes.horizontal.edge();
            const double weight = fan.bearings.size() == 1 ? 1 : aside ? 0 : heard(off, target.turned);
            if (weight > least) points.push_back({beam, target.range, target.power * weight, target.phase});
        }
    return points;
}

}  // namespace echoloop
