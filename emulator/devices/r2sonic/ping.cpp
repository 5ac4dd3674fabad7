#include "emulator/devices/r2sonic/ping.h"

#include <algorithm>
#include <cmath>

#include "protocols/r2sonic/beams.h"

namespace echoloop::r2sonic_device {
namespace {

constexpr double free_running_pause = 10e-3;  // s beyond the range time, measured on a real 2026
constexpr std::size_t most_bins = 4096;

r2sonic::More more_of(const Controls& controls) {
    return {0, static_cast<float>(controls.projector_z), 0, 0, 0, 0};
}

/// First and last angle of the sector, kept within +-80 deg.
std::pair<double, double> sector(const Controls& controls) {
    const double edge = deg_to_rad(80);
    const double first = std::max(controls.sector_rotation - controls.sector_width / 2, -edge);
    const double last = std::min(controls.sector_rotation + controls.sector_width / 2, edge);
    return {first, last};
}

Beams equi_angle(const Controls& controls) {
    const auto [first, last] = sector(controls);
    r2sonic::A0 section{static_cast<float>(first), static_cast<float>(last), more_of(controls)};
    return {section, r2sonic::angles(section, beams)};
}

/// Equal distances on a flat bottom: angles equally spaced in tan.
Beams equi_distant(const Controls& controls) {
    const auto [first, last] = sector(controls);
    const double left = std::tan(first), spacing = (std::tan(last) - left) / (beams - 1);
    std::vector<double> ideal(beams);
    for (std::size_t n = 0; n < beams; ++n) ideal[n] = std::atan(left + spacing * static_cast<double>(n));
    r2sonic::A2 section = r2sonic::pack_angles(ideal);
    section.more = more_of(controls);
    auto angles = r2sonic::angles(section);
    return {std::move(section), std::move(angles)};
}

/// The array's directivity index grows with its area in square wavelengths.
Receiver receiver_at(double frequency, const Acoustics& acoustics) {
    Receiver receiver = acoustics.receiver;
    receiver.directivity_index += 20 * std::log10(frequency / acoustics.reference_frequency);
    return receiver;
}

}  // namespace

double working_sound_speed(const Controls& controls, const Settings& settings) {
    return controls.use_sound_speed ? controls.sound_speed : settings.sound_speed;
}

double range_time(const Controls& controls, const Settings& settings) {
    return 2 * controls.range / working_sound_speed(controls, settings);
}

double ping_period(const Controls& controls, const Settings& settings) {
    const double free = range_time(controls, settings) + free_running_pause;
    return controls.limit_ping_rate ? std::max(free, 1 / controls.ping_rate) : free;
}

std::size_t samples(const Controls& controls, const Settings& settings) {
    return static_cast<std::size_t>(std::ceil(range_time(controls, settings) * sample_rate * 1.01)) + 8;
}

std::size_t samples_per_bin(std::size_t samples) { return (samples + most_bins - 1) / most_bins; }

double receive_beam_width(const Controls& controls, const Acoustics& acoustics) {
    return acoustics.receive_beam_width * acoustics.reference_frequency / controls.frequency;
}

double transmit_beam_width(const Controls& controls, const Acoustics& acoustics) {
    const bool wide = controls.projector == 2;
    const double width = wide ? acoustics.wide_transmit_beam_width : acoustics.transmit_beam_width;
    return width * acoustics.reference_frequency / controls.frequency;
}

Beams beam_angles(const Controls& controls) {
    return controls.equi_distant ? equi_distant(controls) : equi_angle(controls);
}

multibeam::Gates bottom_gates(const Controls& c, double last_depth) {
    multibeam::Gates gates;
    const std::uint32_t mode = c.gate_mode & 0xFF;
    if (mode == 1) gates.depth = {c.gate_min, c.gate_max, c.gate_slope};
    if ((mode == 2 || mode == 3) && last_depth > 0) {
        const double part = std::clamp<double>(c.gate_mode >> 8, 5, 90) / 100;
        gates.depth = {last_depth * (1 - part), last_depth * (1 + part), 0};
    }
    if (c.range_gate) gates.range = {c.range_gate_min, c.range_gate_max};
    return gates;
}

Shot make_shot(const Controls& controls, const Settings& settings, const Beams& fan, std::uint32_t ping) {
    const std::size_t total = samples(controls, settings), per_bin = samples_per_bin(total);
    Shot shot;
    shot.ping = ping;
    shot.bearings = fan.angles;
    shot.tilt = controls.receiver_tilt;
    shot.beam_width = receive_beam_width(controls, settings.acoustics);
    shot.fan_height = transmit_beam_width(controls, settings.acoustics);
    shot.bins = (total + per_bin - 1) / per_bin;
    shot.bin_interval = static_cast<double>(per_bin) / sample_rate;
    shot.frequency = controls.frequency;
    shot.pulse_length = controls.pulse;
    shot.source_level = controls.power > 0 ? controls.power : -300;
    shot.horizontal = settings.acoustics.horizontal;
    shot.vertical = settings.acoustics.vertical;
    shot.receiver = receiver_at(controls.frequency, settings.acoustics);
    if (controls.trigger == 0) shot.interval = ping_period(controls, settings);
    return shot;
}

}  // namespace echoloop::r2sonic_device
