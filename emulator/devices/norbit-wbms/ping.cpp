#include "emulator/devices/norbit-wbms/ping.h"

#include <algorithm>
#include <cmath>

namespace echoloop::norbit_device {
namespace {

constexpr std::size_t most_bins = 4096;
constexpr double longest_range = 600;  // m, of set_range
constexpr double gain_step = 6;        // dB, the document's

/// Port and starboard edge, rad.
std::pair<double, double> sector(const Controls& c, const Settings& s, double sign, bool equidistant) {
    const double edge =
        std::min(s.acoustics.widest_swath / 2, equidistant ? deg_to_rad(80) : deg_to_rad(170));
    const double middle = sign * deg_to_rad(c.direction), half = deg_to_rad(c.opening) / 2;
    const double first = std::clamp(middle - half, -edge, edge - deg_to_rad(1));
    return {first, std::clamp(middle + half, first + deg_to_rad(1), edge)};
}

/// Beams in the middle of equal parts of the sector, or of the line that it spans on a flat bottom.
std::vector<double> make_bearings(double first, double last, std::size_t beams, bool equidistant) {
    const double from = equidistant ? std::tan(first) : first, to = equidistant ? std::tan(last) : last;
    std::vector<double> bearings(beams);
    for (std::size_t n = 0; n < beams; ++n) {
        const double at = from + (to - from) * (static_cast<double>(n) + 0.5) / static_cast<double>(beams);
        bearings[n] = equidistant ? std::atan(at) : at;
    }
    return bearings;
}

multibeam::Gates gates_of(const Controls& c, double sign) {
    multibeam::Gates gates;
    const double slope = sign * deg_to_rad(c.gate_tilt);
    const bool forward = c.mode == 0;  // no depths there
    if (c.gate_mode == 1 && !forward) gates.depth = {c.start, c.stop, slope};
    if (c.gate_mode == 0 || (c.gate_mode == 1 && forward)) gates.range = {c.start, c.stop};
    if (c.gate_mode == 2) gates.range = {c.range_start, c.range_stop};
    if (c.gate_mode == 2 && !forward) gates.depth = {c.depth_start, c.depth_stop, slope};
    return gates;
}

/// Gates that leave nothing are empty at the window's start.
void plan_window(Plan& plan, const Controls& c) {
    const double longest = 2 * longest_range / plan.sound_speed;
    const multibeam::Gates gates = gates_of(c, plan.sign);
    double first = longest, last = 0;
    for (const double bearing : plan.bearings) {
        multibeam::TimeGate gate = multibeam::time_gate(gates, bearing, plan.sound_speed, longest);
        gate.max = std::min(gate.max, longest);
        plan.gates.push_back(gate);
        if (gate.min >= gate.max) continue;
        first = std::min(first, gate.min);
        last = std::max(last, gate.max);
    }
    if (first >= last) first = 0;
    last = std::max(last, first + 64 / plan.sample_rate);
    const double samples = std::ceil((last - first) * plan.sample_rate) + 2;
    plan.samples_per_bin = static_cast<std::size_t>(std::ceil(samples / static_cast<double>(most_bins)));
    plan.first_bin = static_cast<std::size_t>(first * plan.bin_rate());
    plan.bins = static_cast<std::size_t>(samples) / plan.samples_per_bin + 1;
}

}  // namespace

Plan make_plan(const Controls& c, const Settings& s, double digital_gain) {
    const bool equidistant = s.beam_mode == norbit::BeamMode::ed256 && c.mode == 1;
    const std::size_t beams = s.beam_mode == norbit::BeamMode::ea512 ? 512 : 256;
    Plan plan;
    plan.sound_speed = c.sound_velocity > 0 ? c.sound_velocity : s.sound_speed;
    plan.sample_rate = full_sample_rate / c.decimation;
    plan.sign = (c.flip == 0) == s.forward_looking ? 1 : -1;
    const auto [first, last] = sector(c, s, plan.sign, equidistant);
    plan.direction = plan.sign * (first + last) / 2;
    plan.opening = last - first;
    plan.bearings = make_bearings(first, last, beams, equidistant);
    plan_window(plan, c);
    plan.digital_gain = digital_gain;
    plan.due = static_cast<double>(plan.first_bin + plan.bins) / plan.bin_rate() + s.processing_time;
    plan.period = c.rate > 0 ? std::max(1 / c.rate, plan.due) : plan.due;
    return plan;
}

Shot make_shot(const Controls& c, const Plan& plan, const Settings& s, std::uint32_t ping) {
    constexpr double nothing = -300;  // dB
    const Acoustics& a = s.acoustics;
    const double narrower = a.reference_frequency / (1000 * c.frequency);
    Shot shot;
    shot.ping = ping;
    shot.tilt = deg_to_rad(c.tx_direction);
    shot.bearings = plan.bearings;
    shot.beam_width = a.receive_beam_width * narrower;
    shot.fan_height = (s.forward_looking ? a.forward_fan_height : a.transmit_beam_width) * narrower;
    shot.first_bin_time = static_cast<double>(plan.first_bin) / plan.bin_rate();
    shot.bin_interval = 1 / plan.bin_rate();
    shot.bins = plan.bins;
    shot.frequency = 1000 * c.frequency;
    shot.pulse_length = 1e-6 * c.pulse;
    shot.bandwidth = 1000 * c.bandwidth;
    shot.source_level = c.amplitude > 0 ? a.source_level + 20 * std::log10(c.amplitude / 15) : nothing;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    shot.errors = a.errors;
    shot.receiver.directivity_index = std::max(0.0, a.receiver.directivity_index - 20 * std::log10(narrower));
    shot.interval = plan.period;
    return shot;
}

double Vga::at(double time) const {
    if (time <= t1 || t2 <= t1) return time < t2 ? g1 : g2;
    return time >= t2 ? g2 : g1 + (g2 - g1) * (time - t1) / (t2 - t1);
}

Vga make_vga(const Controls& c, const Plan& plan, const Settings& s) {
    const double constant = std::min(c.gain, largest_analog_gain);
    if (!s.tvg || c.vga <= 0) return {0, constant, 0, constant};
    const double per_second = c.vga / 100 * plan.sound_speed;
    return {0, 0, largest_analog_gain / per_second, largest_analog_gain};
}

double first_gain(const Settings& s) {
    return gain_step * std::floor(s.acoustics.largest_gain / 2 / gain_step);
}

double next_gain(const Controls& c, const Settings& s, double now, double peak) {
    constexpr double loudest = 0.9, quietest = 0.4;  // of full scale: more than a step apart
    if (c.autogain == 2) return first_gain(s);
    if (c.autogain == 0 || !(peak > 0)) return now;
    double gain = now;
    const double step = std::pow(10.0, gain_step / 20);
    for (; peak > loudest && gain > 0; peak /= step) gain -= gain_step;
    for (; peak < quietest && gain + gain_step <= s.acoustics.largest_gain; peak *= step) gain += gain_step;
    return std::max(gain, 0.0);
}

}  // namespace echoloop::norbit_device
