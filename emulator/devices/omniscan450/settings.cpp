#include "emulator/devices/omniscan450/settings.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "emulator/devices/family/cerulean/levels.h"

namespace echoloop::omniscan450 {
namespace {

const char* const spec = "Ping specification notes";
constexpr std::uint16_t least_results = 200, most_results = 1200;
constexpr std::uint32_t longest_range = 500000;  // mm
constexpr float typical_pulse = 0.002F, typical_filter = 0.0015F;

void describe_options(Settings& s, OptionList& o) {
    describe(s.identity, o);
    std::string speed_of_sound_id = "116";
    o.choice(speed_of_sound_id, "speed_of_sound_id", {"116", "1002", "both"},
             "message that sets the speed of sound; another is refused with a nack",
             "units in the field refuse 1002, which an older host sends");
    s.takes_1002 = speed_of_sound_id != "116";
    s.takes_116 = speed_of_sound_id != "1002";
    o.choice(s.accept_anything, "invalid_settings", {"nack", "accept"},
             "values outside the documented ranges: refused, or limited to what is possible",
             "own choice, as the ping360");
    o.whole(s.channel, "channel_number", "", 0, 255,
            "in the profile; hosts of two units use 0 port, 1 starboard", "maker's manual");
    o.number(s.mount_bearing, "mount_bearing", "deg", -360, 360,
             "of the transducer, clockwise from the vehicle's bow, for vehicle_heading_deg", "own choice");
    o.number(s.processing_time, "processing_time", "s", 0, 1,
             "from the end of the range to the profile and the next ping",
             "recordings of real units, as a public simulator quotes them");
}

void describe_profile(Acoustics& a, FigureList& f) {
    f.number(a.frequency, "frequency", "Hz", 10e3, 10e6, "of the pulse");
    f.number(a.source_level, "source_level", "dB re 1 uPa at 1 m", 100, 240, "on the axis");
    f.degrees(a.beam_width, "beam_width", 0.05, 60, "-3 dB full width of the narrow side, two-way");
    f.degrees(a.fan_height, "fan_height", 0.1, 120, "-3 dB full width of the wide side, two-way");
    for (std::size_t i = 0; i < gain_steps; ++i)
        f.number(a.gains[i], "gain_" + std::to_string(i), "", 0.01, 1e6,
                 "factor of amplitude at this gain index; the input clips accordingly");
    f.common(a.horizontal, a.vertical, a.receiver);
}

/// A fraction of a ping's time; what is none means the typical one.
double fraction(float value, float typical) {
    constexpr float most = 0.5F;
    return std::isfinite(value) && value > 0 ? std::min(value, most) : typical;
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe_options(s, o);
    describe_profile(s.acoustics, f);
}

Settings read_settings(const DeviceConfig& config) {
    Settings s = fill_settings<Settings>(config);
    s.identity.line.bits_per_second = line_rate(config.endpoints, s.identity.baud);
    Acoustics& a = s.acoustics;
    a.full_scales = cerulean_device::full_scales(a.receiver.saturation_level, a.gains);
    return s;
}

OsPingParams typical_params() {
    OsPingParams params;
    params.length_mm = 5000;
    params.pulse_len_percent = typical_pulse;
    params.filter_duration_percent = typical_filter;
    params.gain_index = -1;
    params.num_results = 600;
    return params;
}

std::optional<std::string_view> out_of_range(const OsPingParams& p) {
    if (p.enable == 0) return std::nullopt;
    if (p.length_mm == 0 || p.length_mm > longest_range || p.start_mm > longest_range)
        return "range out of range";
    if (p.gain_index < -1 || p.gain_index >= static_cast<int>(gain_steps)) return "gain index out of range";
    if (p.num_results < least_results || p.num_results > most_results)
        return "number of results out of range";
    return std::nullopt;
}

OsPingParams limited(OsPingParams p) {
    p.length_mm = std::clamp<std::uint32_t>(p.length_mm, 1, longest_range);
    p.start_mm = std::min(p.start_mm, longest_range);
    p.gain_index = std::clamp<std::int16_t>(p.gain_index, -1, static_cast<std::int16_t>(gain_steps) - 1);
    p.num_results = std::clamp<std::uint16_t>(p.num_results, 1, most_results);
    return p;
}

double window(const State& state) {
    return 2 * (static_cast<double>(state.params.start_mm) + state.params.length_mm) / state.speed_of_sound;
}

double ping_time(const State& state, const Settings& settings) {
    return window(state) + settings.processing_time;
}

double pulse_length(const State& state, const Settings& settings) {
    constexpr double shortest = 10e-6, longest = 10e-3;  // s
    const double wanted =
        fraction(state.params.pulse_len_percent, typical_pulse) * ping_time(state, settings);
    return std::clamp(wanted, shortest, longest);
}

std::size_t filter_bins(const State& state, const Settings& settings) {
    const Shot shot = shot_from(state, settings);
    return static_cast<std::size_t>(
        std::max(1L, std::lround(1 / (shot.receiver.bandwidth * shot.bin_interval))));
}

Shot shot_from(const State& state, const Settings& settings) {
    constexpr double shortest_filter = 2e-6;  // s
    const Acoustics& a = settings.acoustics;
    const OsPingParams& p = state.params;
    const double there_and_back = 2.0 / state.speed_of_sound;  // s per mm
    Shot shot;
    shot.bearings = {0.0};
    shot.beam_width = a.beam_width;
    shot.fan_height = a.fan_height;
    shot.first_bin_time = p.start_mm * there_and_back;
    shot.bins = p.num_results;
    shot.bin_interval = p.length_mm * there_and_back / p.num_results;
    shot.frequency = a.frequency;
    shot.pulse_length = pulse_length(state, settings);
    shot.source_level = a.source_level;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    shot.receiver.saturation_level = a.full_scales.at(state.gain);
    shot.receiver.bandwidth =
        1 / std::max(shortest_filter,
                     fraction(p.filter_duration_percent, typical_filter) * ping_time(state, settings));
    return shot;
}

}  // namespace echoloop::omniscan450
