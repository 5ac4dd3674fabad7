#include "emulator/devices/surveyor240/ping.h"

#include <algorithm>
#include <cmath>

namespace echoloop::surveyor240 {
namespace {

constexpr double shortest_end = 0.5;  // m
constexpr double least_start = 0.05;  // of the end, the maker's definition
constexpr int highest_gain = 100;

bool is_within(double value, double low, double high) { return value >= low && value <= high; }

std::vector<double> directions(const Acoustics& acoustics) {
    const auto last = static_cast<double>(acoustics.directions - 1);
    std::vector<double> bearings(acoustics.directions);
    for (std::size_t n = 0; n < bearings.size(); ++n)
        bearings[n] = acoustics.swath * (static_cast<double>(n) / last - 0.5);
    return bearings;
}

Receiver receiver_at(int gain, const Acoustics& acoustics) {
    Receiver receiver = acoustics.receiver;
    receiver.saturation_level -= gain_db(gain, acoustics);
    return receiver;
}

}  // namespace

Parameters default_parameters() {
    Parameters p;
    p.end_mm = 5000;
    p.sos_mps = 1500;
    p.gain_index = -1;
    p.msec_per_ping = 100;
    p.target_ping_hz = 240000;
    p.n_range_steps = 400;
    p.pulse_len_steps = 1.5;
    return p;
}

std::optional<std::string_view> refusal(const Parameters& p, const Settings& settings) {
    const double end = 1e-3 * p.end_mm, longest = settings.acoustics.longest_range;
    if (p.end_mm != 0 && !is_within(end, shortest_end, longest)) return "end_mm out of range";
    if (p.end_mm != 0 && p.start_mm >= p.end_mm) return "start_mm is not before end_mm";
    if (!is_within(p.sos_mps, 1000, 2000)) return "sos_mps out of range";
    if (!is_within(p.gain_index, -1, highest_gain)) return "gain_index out of range";
    if (p.msec_per_ping < 0) return "msec_per_ping out of range";
    if (p.diagnostic_injected_signal != 0) return "diagnostic_injected_signal must be 0";
    if (p.reserved_for_raw_data != 0) return "reserved_for_raw_data must be false";
    if (!is_within(p.target_ping_hz, 200e3, 280e3)) return "target_ping_hz out of range";
    if (!is_within(p.n_range_steps, 200, 800)) return "n_range_steps out of range";
    if (!is_within(p.pulse_len_steps, 0.5, 50)) return "pulse_len_steps out of range";
    return std::nullopt;
}

Plan make_plan(const Parameters& p, const Automatic& automatic, const Settings& settings) {
    Plan plan;
    plan.sound_speed = p.sos_mps;
    plan.follows_bottom = p.end_mm == 0;
    plan.end =
        plan.follows_bottom ? std::min(automatic.end, settings.acoustics.longest_range) : 1e-3 * p.end_mm;
    const double start = plan.follows_bottom ? 0 : 1e-3 * p.start_mm;
    plan.start = std::max(start, least_start * plan.end);
    plan.steps = p.n_range_steps;
    plan.pulse = p.pulse_len_steps * plan.step_time();
    plan.frequency = p.target_ping_hz;
    plan.automatic_gain = p.gain_index < 0;
    plan.gain = plan.automatic_gain ? automatic.gain : p.gain_index;
    plan.yz = p.enable_yz_point_data != 0;
    plan.atof = p.enable_atof_data != 0;
    plan.period = std::max(1e-3 * p.msec_per_ping, plan.listening() + settings.processing_time);
    return plan;
}

double gain_db(int index, const Acoustics& acoustics) { return acoustics.gain_range * index / highest_gain; }

Shot make_shot(const Plan& plan, const Settings& settings, std::uint32_t ping) {
    const Acoustics& a = settings.acoustics;
    Shot shot;
    shot.ping = ping;
    shot.bearings = directions(a);
    shot.beam_width = a.angle_resolution;
    shot.fan_height = a.fan_height;
    shot.first_bin_time = 2 * plan.start / plan.sound_speed;
    shot.bin_interval = plan.step_time();
    shot.bins = plan.steps;
    shot.frequency = plan.frequency;
    shot.pulse_length = plan.pulse;
    shot.source_level = a.source_level;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = receiver_at(plan.gain, a);
    shot.errors = a.errors;
    shot.interval = plan.period;
    return shot;
}

Shot silent_shot(const Settings& settings) {
    constexpr double nothing = -300;  // dB
    Plan plan;
    plan.end = 1;
    plan.start = 0.9;
    plan.steps = 1;
    plan.pulse = 1e-3;
    plan.frequency = default_parameters().target_ping_hz;
    Shot shot = make_shot(plan, settings, 0);
    shot.bearings = {0.0};
    shot.source_level = nothing;
    shot.interval = 0;
    return shot;
}

Automatic follow(const Plan& plan, Automatic next, double farthest, double loudest,
                 const Settings& settings) {
    constexpr double first_end = Automatic{}.end, shortest_followed = 2, margin = 1.25;
    constexpr double headroom = 12;  // dB
    const Acoustics& a = settings.acoustics;
    if (plan.follows_bottom) {
        const bool lost = farthest <= 0, at_end = plan.end >= a.longest_range;
        const bool fits = is_within(farthest, 0.6 * plan.end, 0.9 * plan.end);
        if (lost) next.end = at_end ? first_end : 2 * plan.end;
        if (!lost && !fits) next.end = margin * farthest;
        next.end = std::clamp(next.end, shortest_followed, a.longest_range);
    }
    if (plan.automatic_gain && a.gain_range > 0) {
        const double wanted = a.receiver.saturation_level - headroom - loudest;
        next.gain =
            static_cast<int>(std::clamp(highest_gain * wanted / a.gain_range, 0.0, 1.0 * highest_gain));
    }
    return next;
}

}  // namespace echoloop::surveyor240
