// What the beams of a fan hear of targets, by their pattern's formula.
#include "render/fan/target_beams.h"

#include <gtest/gtest.h>

#include "render/fan/plan_parts.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

FanPlan plan_of(AxisPattern across, ArrayErrors errors = {}, bool side_lobes = true, bool patterns = true) {
    Shot shot = test::fan(120, 20, 128, 200, 20);
    shot.horizontal = across;
    shot.errors = errors;
    Effects effects;
    effects.set(Effect::side_lobes, side_lobes).set(Effect::beam_pattern, patterns);
    return plan_fan(geometry_of(shot, effects), {});
}

/// By the formula.
double heard(const FanPlan& plan, const TargetEcho& target, std::size_t beam) {
    const FanGeometry& fan = plan.geometry;
    const Lobe lobe = FanLobes(fan, plan.errors).horizontal;
    const double off = target.bearing - fan.bearings[beam], power = lobe.power(off);
    if (!fan.side_lobes && std::abs(off) > lobe.edge()) return 0;
    return fan.horizontal.ways == 2 ? std::sqrt(power * lobe.power(off - target.turned)) : power;
}

void expect_formula(const FanPlan& plan) {
    std::vector<TargetEcho> targets;
    for (const double bearing : {-1.3, -0.8, -0.0123, 0.4567, 1.02, 2.5})
        targets.push_back({.range = 5 + bearing, .power = 1, .phase = bearing, .bearing = bearing});
    targets.back().turned = 0.01;
    TargetBeams beams;
    const auto points = beams.points_of(plan, targets);
    ASSERT_FALSE(points.empty());
    std::size_t next = 0;
    for (std::size_t beam = 0; beam < plan.geometry.bearings.size(); ++beam)
        for (const TargetEcho& target : targets) {
            const double exact = heard(plan, target, beam);
            const bool there =
                next < points.size() && points[next].beam == beam && points[next].phase == target.phase;
            if (exact > 1e-4) {
                ASSERT_TRUE(there) << beam << " " << target.bearing << " " << exact;
                EXPECT_NEAR(10 * std::log10(points[next].power / exact), 0, 0.02 + 2e-6 / exact);
                EXPECT_EQ(points[next].range, target.range);
            }
            next += there;
        }
    EXPECT_EQ(next, points.size()) << "beam by beam, target by target";
}

TEST(TargetBeams, HearByTheirPattern) {
    expect_formula(plan_of({ApertureShape::hamming, 1}));
    expect_formula(plan_of({ApertureShape::line, 2}));
    expect_formula(plan_of({ApertureShape::line, 1}, {}, false));
    expect_formula(plan_of({ApertureShape::line, 1}, {}, true, false));
}

TEST(TargetBeams, HearByWhatStavesDo) {
    const FanPlan plan = plan_of({ApertureShape::hamming, 1}, {1, 0.2, 7});
    ASSERT_NE(plan.errors, nullptr);
    expect_formula(plan);
}

// Several sonars share one, and ask in turns.
TEST(TargetBeams, KnowSeveralFans) {
    const FanPlan one = plan_of({ApertureShape::hamming, 1}), other = plan_of({ApertureShape::line, 2});
    const std::vector<TargetEcho> targets{{.range = 5, .power = 1, .bearing = 0.123}};
    const auto powers = [&](TargetBeams& beams, const FanPlan& plan) {
        std::vector<double> out;
        for (const PointEcho& point : beams.points_of(plan, targets)) out.push_back(point.power);
        return out;
    };
    TargetBeams both, alone;
    const auto first = powers(both, one), second = powers(both, other);
    EXPECT_NE(first, second);
    EXPECT_EQ(powers(both, one), first);
    EXPECT_EQ(powers(alone, other), second);
}

}  // namespace
}  // namespace echoloop
