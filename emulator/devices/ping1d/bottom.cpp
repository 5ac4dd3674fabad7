#include "emulator/devices/ping1d/bottom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "emulator/devices/family/sounder/auto_range.h"
#include "emulator/devices/family/sounder/bottom.h"

namespace echoloop::ping1d {
namespace {

constexpr std::array gain_factors{0.6, 1.8, 5.5, 12.9, 30.2, 66.1, 144.0};
constexpr double no_confidence = 10, full_confidence = 25;  // dB above the noise

/// Time-varied gain in dB at slant range `range`; none closer than a metre.
double tvg(double range, const Acoustics& acoustics) {
    const double r = std::max(range, 1.0);
    return acoustics.tvg_spreading * std::log10(r) + 2 * acoustics.tvg_absorption * r;
}

/// m by the host's speed of sound, middle of the bin.
double range_of(std::size_t bin, const State& state) {
    return 1e-3 * (state.start + (static_cast<double>(bin) + 0.5) * state.length / state.points);
}

/// Two-way s in which echoes drown in the ring-down, which is longer after a longer pulse.
double blanking(const State& state, const Settings& settings) {
    constexpr double speed = 1500;  // m/s, of the water that the data sheet's least distance is for
    return 2 * settings.acoustics.nearest_range / speed + 1e-6 * (state.transmit_duration() - shortest_pulse);
}

echosounder::BottomRule bottom_rule(const State& state, const Settings& settings) {
    echosounder::BottomRule rule;
    rule.blanking = blanking(state, settings);
    rule.margin = no_confidence;
    rule.spreading = settings.acoustics.tvg_spreading;
    rule.absorption = settings.acoustics.tvg_absorption * 1e-3 * state.speed_of_sound;
    return rule;
}

std::uint8_t confidence_of(double above_noise) {
    const double share = (above_noise - no_confidence) / (full_confidence - no_confidence);
    return static_cast<std::uint8_t>(std::lround(100 * std::clamp(share, 0.0, 1.0)));
}

std::size_t first_bin_heard(const State& state, const Settings& settings) {
    const double from = blanking(state, settings) * state.speed_of_sound / 2;  // mm
    const double bins = (from - state.start) * state.points / state.length;
    return static_cast<std::size_t>(std::clamp(std::ceil(bins), 0.0, 1.0 * state.points));
}

}  // namespace

Bottom find_bottom(const Echogram& echogram, const State& state, const Settings& settings) {
    auto rule = bottom_rule(state, settings);
    auto found = echosounder::find_bottom(echogram, rule);
    if (!found) {
        rule.margin = -std::numeric_limits<double>::infinity();
        found = echosounder::find_bottom(echogram, rule);
    }
    if (!found) return {};
    return {static_cast<std::uint32_t>(std::lround(1e3 * range_of(found->bin, state))),
            confidence_of(found->above_noise)};
}

std::vector<std::uint8_t> profile_points(const Echogram& echogram, const State& state,
                                         const Settings& settings) {
    const Acoustics& a = settings.acoustics;
    const auto powers = echogram.beam(0);
    const double gain = 20 * std::log10(gain_factors.at(state.gain)) - a.reference_level;
    std::vector<double> shown(powers.size());
    for (std::size_t bin = 0; bin < powers.size(); ++bin)
        shown[bin] = echogram.rule == EchoRule::cerqueira2016
                         ? 255 * powers[bin]
                         : 255 * (level_db(powers[bin]) + tvg(range_of(bin, state), a) + gain) / a.full_scale;
    const auto heard =
        shown.begin() + static_cast<std::ptrdiff_t>(std::min(first_bin_heard(state, settings), shown.size()));
    const double largest = heard == shown.end() ? 0 : *std::max_element(heard, shown.end());
    const double scale = state.normalise && largest > 0 ? 255 / largest : 1;
    std::vector<std::uint8_t> points(shown.size());
    std::transform(shown.begin(), shown.end(), points.begin(), [&](double v) {
        return static_cast<std::uint8_t>(v > 0 ? std::min(255.0, std::round(v * scale)) : 0);
    });
    return points;
}

std::uint8_t loudest(const std::vector<std::uint8_t>& points, const State& state, const Settings& settings) {
    std::uint8_t most = 0;
    for (std::size_t bin = first_bin_heard(state, settings); bin < points.size(); ++bin)
        most = std::max(most, points[bin]);
    return most;
}

void follow(State& state, const Bottom& bottom, std::uint8_t loudest) {
    constexpr int sure = 50;  // %
    std::optional<std::uint32_t> depth;
    if (bottom.confidence >= sure) depth = bottom.distance;
    state.start = 0;
    state.length = echosounder::next_length(state.length, depth, shortest_length, longest_length);
    if (loudest > 240 && state.gain > 0) --state.gain;
    if (loudest < 120 && state.gain + 1U < gain_factors.size()) ++state.gain;
}

}  // namespace echoloop::ping1d
