#include "emulator/devices/r2sonic/ping.h"

#include <algorithm>
#include <cmath>

#include "protocols/r2sonic/beams.h"

namespace echoloop::r2sonic_device {
namespace {

constexpr double free_running_pause = 10e-3;  // s beyond the range time, measured on a real 2026
constexpr std::size_t most_bins = 4096;

r2sonic::More more_of(const Controls& c, double roll) {
    const auto f = [](double value) { return static_cast<float>(value); };
    return {f(roll), f(c.projector_z), f(c.projector_y), f(c.projector_x), 0, 0};
}

/// First and last beam of the sector, which is kept within +-80 deg. Beams are the middles of its equal
/// cells, as in real A0, A1 and A2.
std::pair<double, double> sector(const Controls& controls, double roll) {
    const double edge = deg_to_rad(80), middle = controls.sector_rotation + roll;
    const double first = std::clamp(middle - controls.sector_width / 2, -edge, edge - deg_to_rad(1));
    const double last = std::clamp(middle + controls.sector_width / 2, first + deg_to_rad(1), edge);
    const double half_cell = (last - first) / 2 / static_cast<double>(beam_count(controls));
    return {first + half_cell, last - half_cell};
}

Beams equi_angle(const Controls& controls, double roll) {
    const auto [first, last] = sector(controls, roll);
    r2sonic::A0 section{static_cast<float>(first), static_cast<float>(last), more_of(controls, roll)};
    return {section, r2sonic::angles(section, beam_count(controls))};
}

/// Equal distances on a plane bottom: angles to its normal that are equally spaced in tan, as in all real A2.
/// A normal from which a beam lies further than 85 deg is brought nearer.
Beams equi_distant(const Controls& controls, double roll, double normal) {
    const std::size_t beams = beam_count(controls);
    const auto [first, last] = sector(controls, roll);
    const double most = deg_to_rad(85), s = std::clamp(normal, last - most, first + most);
    const double left = std::tan(first - s), right = std::tan(last - s);
    const double spacing = (right - left) / static_cast<double>(beams - 1);
    std::vector<double> ideal(beams);
    for (std::size_t n = 0; n < beams; ++n) ideal[n] = std::atan(left + spacing * static_cast<double>(n)) + s;
    r2sonic::A2 section = r2sonic::pack_angles(ideal);
    section.more = more_of(controls, roll);
    auto angles = r2sonic::angles(section);
    return {std::move(section), std::move(angles)};
}

/// Where a flat array looks that steers itself to `wanted` with delays for another sound speed: its sine is
/// `ratio` times that one's, the true speed over the assumed. What would lie along its face or beyond comes
/// to lie side by side near it.
double looks(double wanted, double ratio) {
    if (ratio == 1) return wanted;
    const double along_face = deg_to_rad(85), sine = ratio * std::sin(wanted);
    const double beyond = std::max(0.0, std::abs(sine) - std::sin(along_face));
    if (beyond == 0) return std::asin(sine);
    constexpr double rad_a_sine = 0.3;  // keeps 80 deg, at the worst speeds, below 90
    return std::copysign(along_face + rad_a_sine * beyond, sine);
}

/// The array's directivity index grows with its area in square wavelengths.
Receiver receiver_at(double frequency, const Acoustics& acoustics) {
    Receiver receiver = acoustics.receiver;
    receiver.directivity_index += 20 * std::log10(frequency / acoustics.reference_frequency);
    return receiver;
}

}  // namespace

Attitude attitude_of(const Pose& world_from_sonar) {
    Attitude attitude;
    attitude.depth = std::max(0.0, -world_from_sonar.position.z);
    const Vec3 down = rotate(conjugate(world_from_sonar.orientation), {0, 0, -1});
    if (std::hypot(down.x, down.y) < 0.7 || down.x <= 0) return attitude;  // looks ahead, to the side or up
    attitude.roll = std::atan2(-down.y, down.x);
    attitude.pitch = std::atan2(down.z, std::hypot(down.x, down.y));
    return attitude;
}

std::size_t beam_count(const Controls& controls) { return controls.ultra_high_density ? 1024 : 256; }

double working_sound_speed(const Controls& controls, const Settings& settings) {
    return controls.use_sound_speed ? controls.sound_speed : settings.sound_speed;
}

double shown_sound_speed(const Controls& controls, const Settings& settings, Time now) {
    if (controls.use_sound_speed) return controls.sound_speed;
    return settings.sensors.read("sound speed", settings.sound_speed, stray::sound_speed, now);
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

double bottom_normal(const Seabed& last, double roll) { return last.depth > 0 ? last.slope : roll; }

Beams beam_angles(const Controls& controls, double roll, double normal) {
    const double turned = controls.roll_stabilised ? roll : 0;
    return controls.equi_distant ? equi_distant(controls, turned, normal) : equi_angle(controls, turned);
}

r2sonic::More more_of(const Beams& beams) {
    return std::visit([](const auto& section) { return section.more; }, beams.section);
}

double steering(const Controls& controls, double pitch) {
    const double most = deg_to_rad(10) * 400e3 / controls.frequency;  // the limit of TXS0
    return std::clamp(controls.steering + (controls.pitch_stabilised ? pitch : 0), -most, most);
}

multibeam::Gates bottom_gates(const Controls& c, const Seabed& last) {
    multibeam::Gates gates;
    const std::uint32_t mode = c.gate_mode & 0xFF;
    if (mode == 1) gates.depth = {c.gate_min, c.gate_max, -c.gate_slope};
    if ((mode == 2 || mode == 3) && last.depth > 0) {
        const double part = std::clamp<double>(c.gate_mode >> 8, 5, 90) / 100;
        gates.depth = {last.depth * (1 - part), last.depth * (1 + part), mode == 3 ? last.slope : 0};
    }
    if (c.range_gate) gates.range = {c.range_gate_min, c.range_gate_max};
    return gates;
}

Shot make_shot(const Controls& controls, const Settings& settings, const Beams& fan, double pitch,
               std::uint32_t ping) {
    constexpr double kaiser_loss = 2.3;  // dB, TXW0 in the manual
    const std::size_t total = samples(controls, settings), per_bin = samples_per_bin(total);
    Shot shot;
    shot.ping = ping;
    const double ratio = settings.sound_speed / working_sound_speed(controls, settings);
    for (const double angle : fan.angles) shot.bearings.push_back(looks(angle, ratio));
    shot.tilt = controls.receiver_tilt + looks(steering(controls, pitch), ratio);
    shot.beam_width = receive_beam_width(controls, settings.acoustics);
    shot.fan_height = transmit_beam_width(controls, settings.acoustics);
    shot.bins = (total + per_bin - 1) / per_bin;
    shot.bin_interval = static_cast<double>(per_bin) / sample_rate;
    shot.frequency = controls.frequency;
    shot.pulse_length = controls.pulse;
    shot.source_level = controls.power > 0 ? controls.power : -300;
    shot.horizontal = settings.acoustics.horizontal;
    shot.vertical = settings.acoustics.vertical;
    if (controls.window == 1) {
        shot.source_level -= kaiser_loss;
        shot.vertical.shape = ApertureShape::hamming;  // low side lobes, as a Kaiser window gives them
    }
    shot.receiver = receiver_at(controls.frequency, settings.acoustics);
    shot.errors = settings.acoustics.errors;
    if (controls.trigger == 0) shot.interval = ping_period(controls, settings);
    return shot;
}

}  // namespace echoloop::r2sonic_device
