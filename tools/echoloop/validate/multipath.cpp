// V13: the images of a target in the water's surface, and the double bounce of a corner.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr double multipath_bin = 0.01;  // m

Shot wide_shot() {
    Shot shot = fan(60, 100, 1, 1600, 1600 * multipath_bin);
    shot.pulse_length = 4 * shot.bin_interval;
    return shot;
}

/// A sonar 3 m deep, a target 4 m deep and 10 m away.
std::vector<float> under_surface(bool multipath, double roughness) {
    Effects effects = only({Effect::spreading, Effect::pulse});
    RendererOptions options = with(effects.set(Effect::multipath, multipath));
    options.surface = WaterSurface{0, roughness};
    Renderer renderer(scene_of({}, {{"target", {10, 0, -4}, -10}}), water_of(1500), options);
    return renderer.render(wide_shot(), {{0, 0, -3}, {}}).values;
}

struct Echo {
    double range = 0, level = 0;  ///< m where it begins, dB
};

/// The echo that begins within 0.2 m of `range`.
Echo echo_near(const std::vector<float>& values, double range) {
    const auto begin = static_cast<std::size_t>((range - 0.2) / multipath_bin);
    const std::span part(values.data() + begin, static_cast<std::size_t>(0.4 / multipath_bin));
    if (peak(part) <= 0) return {0, -300};
    return {static_cast<double>(begin + first_bin(part, 0.3)) * multipath_bin, db(peak(part))};
}

void check_surface(Findings& find) {
    const auto values = under_surface(true, 0), direct_only = under_surface(false, 0);
    const Echo direct = echo_near(values, 10.05), one = echo_near(values, 11.128),
               two = echo_near(values, 12.207);
    find.source("image source: sonar 3 m deep, target 4 m deep, 10 m away; one bin and a half");
    find.within("direct echo", "m", 10.050, 0.015, direct.range);
    find.within("by way of the surface once", "m", 11.128, 0.015, one.range);
    find.within("by way of the surface twice", "m", 12.207, 0.015, two.range);
    find.source("the direct echo stays", Kind::property);
    find.within("change of the direct echo by multipath", "dB", 0, 0.01,
                direct.level - echo_near(direct_only, 10.05).level);
    find.source("40 log10(10.050 / 12.207); 20 log10(2 x 10.050 / 12.207), there and back in phase");
    find.within("twice by way of a smooth surface re direct", "dB", -3.38, 0.2, two.level - direct.level);
    find.within("once by way of a smooth surface re direct", "dB", 4.33, 0.2, one.level - direct.level);
    find.source("-1 exp(-2 (k s sin g)^2) each time: s 0.2 mm, 750 kHz, sin g 7 / 12.207");
    find.within("loss of two reflections by roughness", "dB", 4.51, 0.1,
                two.level - echo_near(under_surface(true, 2e-4), 12.207).level);
}

/// Phase of the echo by one reflection, less that of its path's length, in units of pi.
double phase_of_reflection() {
    PathTracer tracer(scene_of({}, {{"target", {10, 0, -4}, -10}}), WaterSurface{},
                      only({Effect::spreading, Effect::multipath}));
    PathEchoes echoes;
    const Shot shot = wide_shot();
    tracer.trace(shot, {{0, 0, -3}, {}}, 1500, 0, 16, echoes);
    for (const TargetEcho& echo : echoes.targets)
        if (echo.bounces == 1) {
            const double path = 4 * std::numbers::pi * shot.frequency / 1500 * echo.range;
            return std::abs(std::remainder(echo.phase - path, 2 * std::numbers::pi)) / std::numbers::pi;
        }
    return -1;
}

/// A corner 10 m ahead of two upright walls at right angles, smooth enough to mirror.
std::shared_ptr<const Scene> corner() {
    constexpr double half = 2, diagonal = half / std::numbers::sqrt2;
    std::vector<Mesh> walls;
    for (const double side : {1.0, -1.0}) {
        Mesh wall = wall_at(0, half, -half, half);
        wall.material.reflection = 0.9;
        wall.material.roughness = 0;
        const Pose world_from_wall{{10 - diagonal, side * diagonal, 0},
                                   axis_angle({0, 0, 1}, side * std::numbers::pi / 4)};
        for (Vec3& p : wall.positions) p = world_from_wall * p;
        walls.push_back(wall);
    }
    return scene_of(walls);
}

void check_corner(Findings& find) {
    const auto heard = [&](bool multipath) {
        Effects effects = only({Effect::spreading, Effect::pulse});
        RendererOptions options = with(effects.set(Effect::multipath, multipath));
        options.surface.reset();
        Renderer renderer(corner(), water_of(1500), options);
        Shot shot = fan(20, 20, 1, 1600, 1600 * multipath_bin);
        shot.pulse_length = 4 * shot.bin_interval;
        return renderer.render(shot, {}).values;
    };
    const auto on = heard(true), off = heard(false);
    std::vector<float> added(on.size());
    std::transform(on.begin(), on.end(), off.begin(), added.begin(), [](float a, float b) { return a - b; });
    find.source("a corner sends back along the way of its edge, 10 m; two bins");
    find.within("range of what a corner's double bounce adds", "m", 10, 0.02,
                peak(added) > 0 ? static_cast<double>(first_bin(added, 0.5)) * multipath_bin : 0);
    find.source("the sonar's image in two mirrors: SL - 20 log10(2 R) + 40 log10(0.9), SL 200 dB");
    find.within("its level", "dB", 172.15, 0.3, db(peak(added)));
}

}  // namespace

void check_multipath(Findings& find) {
    check_surface(find);
    find.source("pressure release: -1");
    find.within("phase of a reflection at the surface", "pi", 1, 0.01, phase_of_reflection());
    check_corner(find);
}

}  // namespace echoloop::validation
