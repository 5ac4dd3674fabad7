#include "emulator/devices/reson-7k/ping.h"

#include <algorithm>
#include <cmath>

namespace echoloop::reson7k_device {
namespace {

constexpr std::size_t most_samples = 4096;

/// A few more than the range needs, at the full rate.
std::size_t full_samples(const Controls& controls, const Settings& settings) {
    return static_cast<std::size_t>(std::ceil(range_time(controls) * settings.acoustics.sample_rate));
}

std::size_t decimation(const Controls& controls, const Settings& settings) {
    return (full_samples(controls, settings) + most_samples - 1) / most_samples;
}

}  // namespace

std::vector<double> beam_angles(const Settings& settings) {
    std::vector<double> angles(settings.beams);
    const double step = settings.swath / static_cast<double>(settings.beams - 1);
    for (std::size_t n = 0; n < angles.size(); ++n)
        angles[n] = -settings.swath / 2 + step * static_cast<double>(n);
    return angles;
}

double width_factor(const Controls& controls, const Settings& settings) {
    return settings.acoustics.frequency / controls.frequency;
}

double range_time(const Controls& controls) { return 2 * controls.range / controls.sound_speed; }

double ping_period(const Controls& controls, const Settings& settings) {
    const double free = range_time(controls) + settings.acoustics.ping_pause;
    return controls.max_rate > 0 ? std::max(free, 1 / controls.max_rate) : free;
}

double sample_rate(const Controls& controls, const Settings& settings) {
    return settings.acoustics.sample_rate / static_cast<double>(decimation(controls, settings));
}

multibeam::TimeGate bottom_gate(const Controls& c, double angle) {
    multibeam::Gates gates;
    if (c.range_filter) gates.range = {c.min_range, c.max_range};
    // The depth gate's slope is positive where it is shallower to starboard; the tilt turns it to starboard.
    if (c.depth_filter) gates.depth = {c.min_depth, c.max_depth, c.gate_tilt};
    return multibeam::time_gate(gates, angle, c.sound_speed, range_time(c));
}

Shot make_shot(const Controls& controls, const Settings& settings, std::uint32_t ping) {
    const Acoustics& a = settings.acoustics;
    const std::size_t per_bin = decimation(controls, settings);
    const double wider = width_factor(controls, settings);
    Shot shot;
    shot.ping = ping;
    shot.bearings = beam_angles(settings);
    shot.beam_width = wider * a.receive_beam_width;
    shot.fan_height = wider * a.transmit_beam_width;
    shot.bins = (full_samples(controls, settings) + per_bin - 1) / per_bin;
    shot.bin_interval = 1 / sample_rate(controls, settings);
    shot.frequency = controls.frequency;
    shot.pulse_length = controls.pulse;
    shot.source_level = controls.power;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    shot.errors = a.errors;
    shot.receiver.directivity_index -= 20 * std::log10(wider);
    shot.interval = ping_period(controls, settings);
    return shot;
}

}  // namespace echoloop::reson7k_device
