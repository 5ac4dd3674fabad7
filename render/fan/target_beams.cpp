#include "render/fan/target_beams.h"

#include <cmath>

#include "render/fan/plan_parts.h"

namespace echoloop {

struct TargetBeams::Known {
    FanGeometry geometry;
    Lobe horizontal;
};

TargetBeams::TargetBeams() = default;
TargetBeams::~TargetBeams() = default;

std::vector<PointEcho> TargetBeams::points_of(const FanPlan& plan, std::span<const TargetEcho> targets) {
    constexpr double least = 1e-8;  // of the axis, two ways: not heard
    std::vector<PointEcho> points;
    if (targets.empty()) return points;
    const FanGeometry& fan = plan.geometry;
    if (fan.bearings.size() == 1) {
        for (const TargetEcho& target : targets)
            points.push_back({0, target.range, target.power, target.phase});
        return points;
    }
    if (!known_ || known_->geometry != fan)
        known_ = std::make_unique<Known>(Known{fan, FanLobes(fan, plan.errors).horizontal});
    const Lobe& horizontal = known_->horizontal;
    const auto heard = [&](double off, double turned) {
        const double back = horizontal.power(off);
        if (turned == 0 || fan.horizontal.ways != 2) return back;
        return std::sqrt(back * horizontal.power(off - turned));
    };
    for (const TargetEcho& target : targets)
        for (std::size_t beam = 0; beam < fan.bearings.size(); ++beam) {
            const double off = target.bearing - fan.bearings[beam];
            const bool aside = !fan.side_lobes && std::abs(off) > horizontal.edge();
            const double weight = aside ? 0 : heard(off, target.turned);
            if (weight > least) points.push_back({beam, target.range, target.power * weight, target.phase});
        }
    return points;
}

}  // namespace echoloop
