// V15: Doppler, and a scanning head on a vehicle that yaws.
#include <cmath>

#include "render/motion.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr double step_deg = 0.25, period = 0.025;  // the head turns 10 deg/s
constexpr double motion_range = 20, separation_deg = 30;

/// deg between the head's directions at which two targets, 30 deg apart, are loudest.
double apparent_separation(double yaw_rate_deg) {
    const auto target = [](double bearing_deg) {
        const double b = deg_to_rad(bearing_deg);
        return PointTarget{"target", {motion_range * std::cos(b), -motion_range * std::sin(b), 0}, -10};
    };
    Renderer renderer(scene_of({}, {target(-separation_deg / 2), target(separation_deg / 2)}), water_of(1500),
                      with(only({Effect::spreading, Effect::beam_pattern, Effect::pulse})));
    Shot shot = fan(3, 20, 1, 400, 25);
    double loudest[2] = {0, 0}, direction[2] = {0, 0};
    for (int i = 0; i <= 200; ++i) {
        const double pan = -25 + step_deg * i;
        shot.pan = deg_to_rad(pan);
        const double yaw = deg_to_rad(yaw_rate_deg * period * i);
        const double heard = peak(renderer.render(shot, {{}, from_rpy(0, 0, yaw)}).values);
        const int side = pan < yaw_rate_deg * period * i ? 0 : 1;
        if (heard > loudest[side]) loudest[side] = heard, direction[side] = pan;
    }
    return direction[1] - direction[0];
}

}  // namespace

void check_motion(Findings& find) {
    find.source("2 v f / c: 1 m/s, 750 kHz, 1500 m/s");
    find.within("Doppler shift", "Hz", 1000, 1, doppler_shift(750e3, 1, 1500));
    find.source("yaw rate times the time between the two: 2 deg/s, 3.75 s at 10 deg/s; a step of the head");
    const double still = apparent_separation(0);
    find.within("targets 30 deg apart, still vehicle", "deg", 30, step_deg, still);
    find.within("smear by a vehicle that yaws against the head", "deg", 7.5, 2 * step_deg,
                apparent_separation(2) - still);
}

}  // namespace echoloop::validation
