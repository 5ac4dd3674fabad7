// V37 and V38: a sonar that moves and turns while its ping is under way.
#include <cmath>
#include <numeric>

#include "render/motion.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr double yaw_rate_deg = 30;

RendererOptions in_motion() {
    return with(only({Effect::spreading, Effect::beam_pattern, Effect::side_lobes, Effect::motion}));
}

Situation yawing() {
    Situation situation;
    situation.turning = {0, 0, deg_to_rad(yaw_rate_deg)};
    return situation;
}

Situation nearing(double speed) {
    Situation situation;
    situation.velocity = {speed, 0, 0};
    return situation;
}

Renderer before(double range) {
    return Renderer(scene_of({}, {{"target", {range, 0, 0}, -10}}), water_of(1500), in_motion());
}

/// Beams of 1 deg, every half a degree, that transmit wide.
Shot imaging(double range) {
    Shot shot = fan(20, 20, 40, 400, 1.1 * range);
    shot.beam_width = deg_to_rad(1);
    shot.horizontal = {ApertureShape::hamming, 1};
    return shot;
}

/// deg, the middle of what all beams hear.
double bearing_of_target(double range, const Situation& situation) {
    Renderer renderer = before(range);
    const Echogram e = renderer.render(imaging(range), situation);
    double sum = 0, moment = 0;
    for (std::size_t beam = 0; beam < e.beams(); ++beam) {
        const double heard = total(e.beam(beam));
        sum += heard, moment += heard * rad_to_deg(e.shot.bearings[beam]);
    }
    return moment / sum;
}

/// A plain line of 3 deg one way, which transmits and receives.
Shot head(double pan_deg) {
    Shot shot = fan(3 * 1.001906 / 1.391557, 20, 1, 200, 55);
    shot.pan = deg_to_rad(pan_deg);
    return shot;
}

void check_head(Findings& find) {
    Renderer renderer = before(50);
    double best = 0, at = 0;
    for (double pan = -3; pan <= 1; pan += 0.05) {
        const double heard = total(renderer.render(head(pan), yawing()).values);
        if (heard > best) best = heard, at = pan;
    }
    find.within("head of 3 deg at 50 m: bearing at which it hears best", "deg", 1.0, 0.1, std::abs(at));
    find.within("its loss there", "dB", -2.57, 0.2, db(best / total(renderer.render(head(0), {}).values)));
    Renderer wall(scene_of({wall_at(50, 60, -1, 1)}), water_of(1500), in_motion());
    double still = 0, turned = 0;
    for (std::uint64_t ping = 0; ping < 64; ++ping) {
        Shot shot = head(0);
        shot.ping = ping;
        still += total(wall.render(shot, {}).values), turned += total(wall.render(shot, yawing()).values);
    }
    find.within("of what is everywhere", "dB", -3.02, 0.2, db(turned / still));
}

/// m, the middle of what a beam hears of a target 20 m away.
double range_of_target(Shot shot, double speed) {
    Renderer renderer = before(20);
    const Echogram e = renderer.render(shot, nearing(speed));
    double sum = 0, moment = 0;
    for (std::size_t bin = 0; bin < shot.bins; ++bin)
        sum += e.values[bin], moment += e.values[bin] * e.bin_range(bin);
    return moment / sum;
}

void check_sweep(Findings& find, const char* name, double pulse_length, double bandwidth, double bias) {
    Shot shot = fan(2, 2, 1, 1500, 25);  // bins of 1 mm from 19 m on
    shot.first_bin_time = 2 * 19.0 / 1500, shot.bin_interval = 2e-3 / 1500;
    shot.frequency = 300e3;
    const double steady = range_of_target(shot, 0) - range_of_target(shot, 1);
    shot.pulse_length = pulse_length, shot.bandwidth = bandwidth;
    find.within(name, "m", bias, 0.003, range_of_target(shot, 0) - range_of_target(shot, 1) - steady);
}

/// m/s along a beam 30 deg off the vertical over a flat floor, at 1 m/s ahead; the mean over a few pings.
ClosingSpeed along_janus_beam() {
    Renderer renderer(scene_of({floor_at(-10, 60)}), water_of(1500), in_motion());
    Shot shot = fan(4, 4, 1, 300, 15);
    shot.horizontal = shot.vertical = {ApertureShape::piston, 2};
    shot.tilt = deg_to_rad(-60);
    shot.velocities = true;
    double power = 0, mean = 0, square = 0;
    for (; shot.ping < 16; ++shot.ping) {
        const Echogram e = renderer.render(shot, nearing(1));
        for (std::size_t i = 0; i < e.values.size(); ++i) {
            if (!(e.values[i] > 0)) continue;
            const ClosingSpeed speed = e.velocities[i];
            power += e.values[i], mean += e.values[i] * speed.mean;
            square += e.values[i] * (speed.mean * speed.mean + speed.spread * speed.spread);
        }
    }
    mean /= power;
    return {static_cast<float>(mean), static_cast<float>(std::sqrt(square / power - mean * mean))};
}

}  // namespace

void check_turn_in_flight(Findings& find) {
    find.source("w 2R / c: 30 deg/s, 1500 m/s");
    const std::pair<double, double> turned[] = {{10, 0.4}, {40, 1.6}, {50, 2.0}, {100, 4.0}};
    for (const auto& [range, degrees] : turned)
        find.within("turn in flight at " + std::to_string(static_cast<int>(range)) + " m", "deg", degrees,
                    0.02, bearing_of_target(range, yawing()));
    find.source("2 R w / c times R");
    find.within("shear of a picture at 40 m", "m", 1.117, 0.02,
                40 * deg_to_rad(bearing_of_target(40, yawing()) - bearing_of_target(40, {})));
    find.source("b(b) b(b - 2 deg) of an unshaded line, its maximum and integral");
    check_head(find);
}

void check_doppler(Findings& find) {
    find.source("f (1 + v/c) / (1 - v/c) - f: 600 kHz, 2 m/s, 1500 m/s");
    find.within("Doppler shift", "Hz", 1602.1, 1, doppler_shift(600e3, 2, 1500));
    find.source("v f0 T / B: 300 kHz, 1 m/s");
    check_sweep(find, "range of a chirp of 12 ms, 10 kHz: too near by", 12e-3, 10e3, 0.360);
    check_sweep(find, "the same of 4 ms, 40 kHz", 4e-3, 40e3, 0.0300);
    find.source("2 v f sin 30 / c: 600 kHz, 1 m/s");
    const ClosingSpeed along = along_janus_beam();
    find.within("Doppler shift along a beam 30 deg off the vertical", "Hz", 400, 4,
                doppler_shift(600e3, double{along.mean}, 1500));
}

}  // namespace echoloop::validation
