#include "emulator/devices/s500/settings.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "emulator/devices/family/cerulean/levels.h"
#include "protocols/ping/framer.h"

namespace echoloop::s500 {
namespace {

const char* const spec = "Ping specification notes";
constexpr std::uint32_t longest_length = 500000;  // mm
constexpr std::size_t most_results = 6000;
/// A profile of at most 4076 bytes, for the buffers of 4096 that hosts in the field have.
constexpr std::size_t most_automatic_results = 2000;

void describe_options(Settings& s, OptionList& o) {
    describe(s.identity, o);
    o.choice(s.accept_anything, "invalid_settings", {"nack", "accept"},
             "values outside the documented ranges: refused, or limited to what is possible",
             "own choice, as the ping360");
    o.number(s.processing_time, "processing_time", "s", 0, 1,
             "from the end of the range to the report and the next ping", "as the omniscan450");
    o.whole(s.processor_temperature, "processor_temperature", "0.01 degC", 0, 65535, "reported on request",
            spec);
    o.choice(s.long_temperature, "temperature_bytes", {"2", "4"},
             "of 1213: as units in the field send it, or as the maker's definition has it",
             "an owner's public report");
}

void describe_profile(Acoustics& a, FigureList& f) {
    f.number(a.frequency, "frequency", "Hz", 10e3, 10e6, "of the tone, and the middle of the chirp");
    f.number(a.chirp_width, "chirp_width", "Hz", 1e3, 5e6, "from the chirp's beginning to its end");
    f.number(a.source_level, "source_level", "dB re 1 uPa at 1 m", 100, 240, "on the axis");
    f.degrees(a.beam_width, "beam_width", 0.1, 120, "-3 dB full width of the cone, two-way");
    f.number(a.nearest_range, "nearest_range", "m", 0, 10, "nothing closer is taken for the bottom");
    f.number(a.absorption, "absorption", "dB/m", 0, 2, "one way, compensated before echoes are compared");
    f.number(a.lowest_gain, "lowest_gain", "", 0.01, 1e6, "factor of amplitude at gain index 0");
    f.number(a.gain_step, "gain_step", "dB", 0, 20,
             "from one gain index to the next; the input clips accordingly");
    f.number(a.sample_rate, "sample_rate", "Hz", 1e3, 1e8,
             "of the converter; a chirp's results are samples at a whole fraction of it");
    f.common(a.horizontal, a.vertical, a.receiver);
}

void set_gains(Acoustics& a) {
    for (int i = 0; i <= highest_gain; ++i)
        a.gains.push_back(a.lowest_gain * std::pow(10, a.gain_step * i / 20));
    a.full_scales = cerulean_device::full_scales(a.receiver.saturation_level, a.gains);
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

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe_options(s, o);
    describe_profile(s.acoustics, f);
}

Settings read_settings(const DeviceConfig& config) {
    Settings s = fill_settings<Settings>(config);
    s.identity.line.bits_per_second = line_rate(config.endpoints, s.identity.baud);
    set_gains(s.acoustics);
    return s;
}

bool is_range(const SetPingParams& p) {
    return p.length_mm <= longest_length && p.start_mm <= longest_length;
}

std::optional<std::string_view> out_of_range(const SetPingParams& p) {
    if (p.report_id == 0) return std::nullopt;
    if (!is_report(p.report_id)) return "report id out of range";
    if (!is_range(p)) return "range out of range";
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

double ping_time(const State& state, const Settings& settings) {
    return window(state) + settings.processing_time;
}

Resolution resolution(const State& state, const Settings& settings) {
    if (state.params.chirp == 0) return {};
    const double samples =
        std::max(1.0, 2.0 * state.length / state.speed_of_sound * settings.acoustics.sample_rate);
    const bool automatic = state.params.decimation == 0;
    const double least = std::ceil(samples / (automatic ? most_automatic_results : most_results));
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
