// V1: EL = SL - 2 TL + TS with TL = 20 log10 R + a R, measured with point targets on the axis.
#include <cmath>
#include <cstdio>

#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/statistics.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr double strength = -20;
constexpr double ranges[] = {2, 3, 5, 8, 10, 13, 20, 30, 50, 60};

Renderer loss_renderer() {
    std::vector<PointTarget> targets;
    for (const double range : ranges) targets.push_back({"target", {range, 0, 0}, strength});
    return {scene_of({}, targets), Water{},
            with(only({Effect::spreading, Effect::absorption, Effect::beam_pattern, Effect::pulse}))};
}

/// Two-way loss in dB of the echo from `range` m.
double loss(Renderer& renderer, double frequency, double range) {
    Shot shot = pencil(range + 2, 100e-6);
    shot.frequency = frequency;
    const Echogram e = renderer.render(shot, {});
    const auto near = static_cast<std::size_t>((range - 0.3) * 2 / e.sound_speed / shot.bin_interval);
    return shot.source_level + strength - db(peak(e.beam(0).subspan(near)));
}

}  // namespace

void check_sonar_equation(Findings& find) {
    Renderer renderer = loss_renderer();
    find.source("sonar equation with Francois & Garrison 1982; T 10 C, S 35, pH 8, depth 0");
    const struct {
        double kilohertz, range, loss;
    } table[] = {{750, 50, 90.20}, {900, 10, 45.99}, {900, 60, 107.06}, {2250, 5, 44.17}, {115, 50, 71.72}};
    for (const auto& row : table) {
        char name[80];
        std::snprintf(name, sizeof name, "two-way loss at %.0f kHz and %.0f m", row.kilohertz, row.range);
        find.within(name, "dB", row.loss, 0.2, loss(renderer, row.kilohertz * 1e3, row.range));
    }
    Curve curve{"measured", {}, true}, law{"-40 log10 R", {}, false};
    for (const double range : ranges) {
        if (range > 50) continue;
        const double absorbed = 2 * absorption_db_per_km(renderer.water(), 750e3) / 1e3 * range;
        curve.points.emplace_back(std::log10(range), absorbed - loss(renderer, 750e3, range));
        law.points.emplace_back(std::log10(range), -40 * std::log10(range));
    }
    find.source("spherical spreading");
    find.within("slope of level + 2 a R over log10 R, 2 to 50 m", "dB", -40, 0.3, slope(curve.points));
    find.plot("spreading", {"Level of a point target, absorption taken out",
                            "log10 of the range in m",
                            "dB re 1 m",
                            {law, curve},
                            -70,
                            0});
}

}  // namespace echoloop::validation
