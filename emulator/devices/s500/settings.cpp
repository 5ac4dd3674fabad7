#include "emulator/devices/s500/settings.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "emulator/devices/family/cerulean/levels.h"
#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"
#include "protocols/ping/framer.h"

namespace echoloop::s500 {
namespace {

const char* const spec = "Ping specification notes";
constexpr int highest_gain = 13;
constexpr std::uint32_t longest_length = 500000;  // mm
constexpr std::size_t most_results = 6000;

Acoustics read_acoustics(const Profile& p) {
    Acoustics a;
    a.frequency = figure(p, "frequency");
    a.chirp_width = figure(p, "chirp_width");
    a.source_level = figure(p, "source_level");
    a.beam_width = deg_to_rad(figure(p, "beam_width"));
    a.horizontal = axis_pattern(p, "horizontal");
    a.vertical = axis_pattern(p, "vertical");
    a.receiver = receiver(p);
    for (int i = 0; i <= highest_gain; ++i)
        a.gains.push_back(figure(p, "lowest_gain") * std::pow(10, figure(p, "gain_step") * i / 20));
    a.full_scales = cerulean_device::full_scales(a.receiver.saturation_level, a.gains);
    a.nearest_range = figure(p, "nearest_range");
    a.absorption = figure(p, "absorption");
    a.sample_rate = figure(p, "sample_rate");
    return a;
}

bool is_report(std::uint16_t id) {
    return id == static_cast<std::uint16_t>(cerulean::Id::distance2) ||
           id == static_cast<std::uint16_t>(cerulean::Id::profile6);
}

/// Public hosts that read 4096 bytes at a time wait for more after a message that fills them exactly.
std::size_t no_trap(std::size_t results) {
    constexpr std::size_t read_size = 4096, fixed = 66 + ping::min_frame_bytes;
    return (fixed + 2 * results) % read_size == 0 ? results - 1 : results;
}

/// Long enough to carry, short enough to resolve; a chirp is compressed.
double pulse_length(const State& state) {
    constexpr double share = 0.002, chirp_share = 0.02, shortest = 20e-6, longest = 2e-3;
    return std::clamp((state.params.chirp != 0 ? chirp_share : share) * window(state), shortest, longest);
}

}  // namespace

std::uint16_t State::interval() const {
    return static_cast<std::uint16_t>(std::max<std::int16_t>(params.msec_per_ping, 0));
}

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"frequency", "Hz", "of the tone, and the middle of the chirp", 10e3, 10e6},
        {"chirp_width", "Hz", "from the chirp's beginning to its end", 1e3, 5e6},
        {"source_level", "dB re 1 uPa at 1 m", "on the axis", 100, 240},
        {"beam_width", "deg", "-3 dB full width of the cone, two-way", 0.1, 120},
        {"nearest_range", "m", "nothing closer is taken for the bottom", 0, 10},
        {"absorption", "dB/m", "one way, given back before echoes are compared", 0, 2},
        {"lowest_gain", "", "factor of amplitude at gain index 0", 0.01, 1e6},
        {"gain_step", "dB", "from one gain index to the next; the input clips accordingly", 0, 20},
        {"sample_rate", "Hz", "of the converter; a chirp's results are every so manieth sample", 1e3, 1e8},
    };
    auto common = common_figures();
    std::move(common.begin(), common.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table() {
    constexpr int listed_type = 112;
    auto all = cerulean_device::identity_options(listed_type, "SONAR S500", false);
    const Option own[] = {
        choice_row("invalid_settings", {"nack", "accept"},
                   "values outside the documented ranges: refused, or cut to what can be pinged",
                   "own choice, as the ping360"),
        number_row("processing", "ms", 2, 0, 1000,
                   "from the end of the range to the report and the next ping", "as the omniscan450"),
        integer_row("processor_temperature", "0.01 degC", 4000, 0, 65535, "told on request", spec),
    };
    all.insert(all.end(), std::begin(own), std::end(own));
    return all;
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.identity = cerulean_device::read_identity(config);
    s.accept_anything = text(o, "invalid_settings") == "accept";
    s.processing = number(o, "processing") * 1e-3;
    s.processor_temperature = static_cast<std::uint32_t>(integer(o, "processor_temperature"));
    s.acoustics = read_acoustics(config.profile);
    return s;
}

std::optional<std::string_view> out_of_range(const SetPingParams& p) {
    if (p.report_id == 0) return std::nullopt;
    if (!is_report(p.report_id)) return "report id out of range";
    if (p.length_mm > longest_length || p.start_mm > longest_length) return "range out of range";
    if (p.gain_index < -1 || p.gain_index > highest_gain) return "gain index out of range";
    if (p.msec_per_ping < -1) return "ping interval out of range";
    return std::nullopt;
}

SetPingParams limited(SetPingParams p) {
    p.length_mm = std::min(p.length_mm, longest_length);
    p.start_mm = std::min(p.start_mm, longest_length);
    p.gain_index = std::clamp<std::int16_t>(p.gain_index, -1, highest_gain);
    p.msec_per_ping = std::max<std::int16_t>(p.msec_per_ping, -1);
    return p;
}

double window(const State& state) {
    return 2 * (static_cast<double>(state.params.start_mm) + state.length) / state.speed_of_sound;
}

double ping_time(const State& state, const Settings& settings) { return window(state) + settings.processing; }

Resolution resolution(const State& state, const Settings& settings) {
    if (state.params.chirp == 0) return {};
    const double samples =
        std::max(1.0, 2.0 * state.length / state.speed_of_sound * settings.acoustics.sample_rate);
    const double least = std::ceil(samples / most_results);
    const double decimation = std::clamp(std::max(least, 1.0 * state.params.decimation), 1.0, 255.0);
    const double results = std::clamp(std::floor(samples / decimation), 1.0, 1.0 * most_results);
    return {no_trap(static_cast<std::size_t>(results)), static_cast<std::uint8_t>(decimation)};
}

Shot shot_from(const State& state, const Settings& settings) {
    const Acoustics& a = settings.acoustics;
    const double there_and_back = 2.0 / state.speed_of_sound;  // s per mm
    Shot shot;
    shot.bearings = {0.0};
    shot.beam_width = shot.fan_height = a.beam_width;
    shot.first_bin_time = state.params.start_mm * there_and_back;
    shot.bins = resolution(state, settings).results;
    shot.bin_interval = state.length * there_and_back / static_cast<double>(shot.bins);
    shot.frequency = a.frequency;
    shot.pulse_length = pulse_length(state);
    shot.bandwidth = state.params.chirp != 0 ? a.chirp_width : 0;
    shot.source_level = a.source_level;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    shot.receiver.saturation_level = a.full_scales.at(state.gain);
    return shot;
}

}  // namespace echoloop::s500
