#include "emulator/devices/omniscan450/settings.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "emulator/devices/family/cerulean/levels.h"
#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::omniscan450 {
namespace {

const char* const spec = "Ping specification notes";
constexpr std::size_t gain_steps = 8;
constexpr std::uint16_t least_results = 200, most_results = 1200;
constexpr std::uint32_t longest_range = 500000;  // mm
constexpr float typical_pulse = 0.002F, typical_filter = 0.0015F;

std::string gain_name(std::size_t index) { return "gain_" + std::to_string(index); }

Acoustics read_acoustics(const Profile& p) {
    Acoustics a;
    a.frequency = figure(p, "frequency");
    a.source_level = figure(p, "source_level");
    a.beam_width = deg_to_rad(figure(p, "beam_width"));
    a.fan_height = deg_to_rad(figure(p, "fan_height"));
    a.horizontal = axis_pattern(p, "horizontal");
    a.vertical = axis_pattern(p, "vertical");
    a.receiver = receiver(p);
    for (std::size_t i = 0; i < gain_steps; ++i) a.gains.push_back(figure(p, gain_name(i)));
    a.full_scales = cerulean_device::full_scales(a.receiver.saturation_level, a.gains);
    return a;
}

/// A fraction of a ping's time; what is none means the typical one.
double fraction(float value, float typical) {
    constexpr float most = 0.5F;
    return std::isfinite(value) && value > 0 ? std::min(value, most) : typical;
}

}  // namespace

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"frequency", "Hz", "of the pulse", 10e3, 10e6},
        {"source_level", "dB re 1 uPa at 1 m", "on the axis", 100, 240},
        {"beam_width", "deg", "-3 dB full width of the narrow side, two-way", 0.05, 60},
        {"fan_height", "deg", "-3 dB full width of the wide side, two-way", 0.1, 120},
    };
    for (std::size_t i = 0; i < gain_steps; ++i)
        rows.push_back({gain_name(i), "",
                        "factor of amplitude at this gain index; the input clips accordingly", 0.01, 1e6});
    auto common = common_figures();
    std::move(common.begin(), common.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table() {
    constexpr int listed_type = 101;
    auto all = cerulean_device::identity_options(listed_type, "SONAR OMNISCAN450", false);
    const Option own[] = {
        choice_row("speed_of_sound_id", {"both", "1002", "116"}, "message that sets the speed of sound",
                   spec),
        choice_row("invalid_settings", {"nack", "accept"},
                   "values outside the documented ranges: refused, or cut to what can be pinged",
                   "own choice, as the ping360"),
        integer_row("channel_number", "", 0, 0, 255,
                    "in the profile; hosts of two units use 0 port, 1 starboard", "maker's manual"),
        number_row("mount_bearing", "deg", 0, -360, 360,
                   "of the transducer, clockwise against the vehicle, for vehicle_heading_deg", "own choice"),
        number_row("processing", "ms", 2, 0, 1000,
                   "from the end of the range to the profile and the next ping",
                   "recordings of real units, as a public simulator quotes them"),
    };
    all.insert(all.end(), std::begin(own), std::end(own));
    return all;
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.identity = cerulean_device::read_identity(config);
    s.takes_1002 = text(o, "speed_of_sound_id") != "116";
    s.takes_116 = text(o, "speed_of_sound_id") != "1002";
    s.accept_anything = text(o, "invalid_settings") == "accept";
    s.channel = static_cast<std::uint8_t>(integer(o, "channel_number"));
    s.mount_bearing = number(o, "mount_bearing");
    s.processing = number(o, "processing") * 1e-3;
    s.acoustics = read_acoustics(config.profile);
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

double ping_time(const State& state, const Settings& settings) { return window(state) + settings.processing; }

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
