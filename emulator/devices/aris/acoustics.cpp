#include "emulator/devices/aris/acoustics.h"

#include <algorithm>
#include <cmath>

namespace echoloop::aris_device {
namespace {

constexpr std::uint32_t spare_time = 360;  // us of a cycle that are not heard

template <class T>
bool within(T value, T low, T high) {
    return value >= low && value <= high;
}

bool in_range(const aris::SetAcoustics& w) {
    return w.cookie > 0 && within(w.frame_rate, 1.0F, 15.0F) && within(w.samples, 128U, 4096U) &&
           within(w.start_delay, 930U, 60000U) && within(w.cycle_period, 1802U, 150000U) &&
           within(w.sample_period, 4U, 100U) && within(w.pulse_width, 5U, 80U) && w.frequency <= 1 &&
           within(w.gain, 0.0F, 24.0F);
}

}  // namespace

bool is_valid(const aris::SetAcoustics& w, const Settings& settings) {
    const Variant& variant = settings.variant;
    const bool has_mode = w.ping_mode == variant.first_mode || w.ping_mode == variant.second_mode;
    if (!in_range(w) || !has_mode) return false;
    const auto pings = static_cast<double>(aris::find_ping_mode(w.ping_mode)->pings);
    const bool frame_fits = std::ceil(1e6 / static_cast<double>(w.frame_rate)) > w.cycle_period * pings;
    return frame_fits && w.cycle_period >= w.start_delay + w.sample_period * w.samples + spare_time;
}

const Carrier& carrier_of(const aris::SetAcoustics& w, const Settings& s) {
    return w.frequency == 1 ? s.acoustics.high : s.acoustics.low;
}

aris::SetAcoustics constrained(const aris::SetAcoustics& wish, const Settings& s) {
    const Carrier& carrier = carrier_of(wish, s);
    const double unit = s.pulse_in_cycles ? carrier.frequency / 1e6 : 1;  // per us
    const double limit = carrier.pulse_limit * unit;
    const double energy = s.acoustics.energy_limit * unit / static_cast<double>(wish.frame_rate);
    constexpr double rounding = 1e-9;
    const double longest = std::max(1.0, std::floor(std::min(limit, energy) + rounding));
    aris::SetAcoustics out = wish;
    out.pulse_width = std::min(wish.pulse_width, static_cast<std::uint32_t>(longest));
    return out;
}

double frame_time(const aris::SetAcoustics& acoustics) {
    return 1e-6 * acoustics.cycle_period *
           static_cast<double>(aris::find_ping_mode(acoustics.ping_mode)->pings);
}

Shot make_shot(const aris::SetAcoustics& w, bool telephoto, const Settings& s, std::uint64_t ping) {
    constexpr double silent = 0;  // dB
    const Acoustics& a = s.acoustics;
    const Carrier& carrier = carrier_of(w, s);
    const auto angles = aris::centre_angles(aris::find_ping_mode(w.ping_mode)->beams, telephoto);
    const double magnification = telephoto ? 0.5 : 1;
    Shot shot;
    shot.ping = ping;
    // Beam 0 is the right-most: clockwise they come the other way round.
    for (auto angle = angles.rbegin(); angle != angles.rend(); ++angle)
        shot.bearings.push_back(deg_to_rad(-*angle));
    shot.beam_width = carrier.beam_width * magnification;
    shot.fan_height = a.fan_height * magnification;
    shot.first_bin_time = 1e-6 * w.start_delay;
    shot.bin_interval = 1e-6 * w.sample_period;
    shot.bins = w.samples;
    shot.frequency = carrier.frequency;
    shot.pulse_length = w.pulse_width / (s.pulse_in_cycles ? carrier.frequency : 1e6);
    shot.source_level = w.transmit ? carrier.source_level - (w.volts_150 ? 0 : a.low_voltage_loss) : silent;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    shot.errors = a.errors;
    shot.receiver.directivity_index = carrier.directivity_index;
    shot.interval = 1 / static_cast<double>(w.frame_rate);
    return shot;
}

double sound_speed(double t, double s, double z) {
    return 1402.5 + 5 * t - 5.44e-2 * t * t + 2.1e-4 * t * t * t + 1.33 * s - 1.23e-2 * s * t +
           8.7e-5 * s * t * t + 1.56e-2 * z + 2.55e-7 * z * z - 7.3e-12 * z * z * z;
}

}  // namespace echoloop::aris_device
