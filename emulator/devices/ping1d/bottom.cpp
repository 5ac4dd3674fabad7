#include "emulator/devices/ping1d/bottom.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace echoloop::ping1d {
namespace {

constexpr std::array gain_factors{0.6, 1.8, 5.5, 12.9, 30.2, 66.1, 144.0};

/// Time-varied gain in dB at slant range `range`; none closer than a metre.
double tvg(double range, const Acoustics& acoustics) {
    const double r = std::max(range, 1.0);
    return acoustics.tvg_spreading * std::log10(r) + 2 * acoustics.tvg_absorption * r;
}

/// m by the host's speed of sound, middle of the bin.
double range_of(std::size_t bin, const State& state) {
    return 1e-3 * (state.start + (static_cast<double>(bin) + 0.5) * state.length / state.points);
}

/// Mean power of the noise from the quieter quarter: of an exponential distribution that lies at 0.288 of the
/// mean.
double noise_power(std::span<const float> powers) {
    std::vector<float> sorted(powers.begin(), powers.end());
    const auto quarter = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 4);
    std::nth_element(sorted.begin(), quarter, sorted.end());
    return *quarter / 0.288;
}

std::uint8_t confidence_of(double power, double noise) {
    constexpr double none = 10, full = 25;  // dB
    if (!(power > 0)) return 0;
    const double above = noise > 0 ? 10 * std::log10(power / noise) : full;
    return static_cast<std::uint8_t>(std::lround(std::clamp((above - none) / (full - none), 0.0, 1.0) * 100));
}

}  // namespace

Bottom find_bottom(const Echogram& echogram, const State& state, const Settings& settings) {
    constexpr double edge = 10;            // dB below the strongest point
    constexpr double longest_rise = 0.15;  // of its range
    const auto powers = echogram.beam(0);
    std::vector<double> levels(powers.size(), -1e300);
    for (std::size_t bin = 0; bin < powers.size(); ++bin) {
        const double range = range_of(bin, state);
        if (range >= settings.acoustics.nearest_range && powers[bin] > 0)
            levels[bin] = level_db(powers[bin]) + tvg(range, settings.acoustics);
    }
    const auto strongest = std::max_element(levels.begin(), levels.end());
    if (strongest == levels.end() || *strongest < -1e299) return {};
    const auto peak = static_cast<std::size_t>(strongest - levels.begin());
    const double from = range_of(peak, state) * (1 - longest_rise);
    std::size_t first = peak;
    for (std::size_t bin = 0; bin < peak && first == peak; ++bin)
        if (range_of(bin, state) >= from && levels[bin] >= *strongest - edge) first = bin;
    return {static_cast<std::uint32_t>(std::lround(1e3 * range_of(first, state))),
            confidence_of(powers[peak], noise_power(powers))};
}

std::vector<std::uint8_t> profile_points(const Echogram& echogram, const State& state,
                                         const Settings& settings) {
    const Acoustics& a = settings.acoustics;
    const auto powers = echogram.beam(0);
    const double gain = 20 * std::log10(gain_factors.at(state.gain)) - a.reference_level;
    std::vector<double> shown(powers.size());
    double largest = 0;
    for (std::size_t bin = 0; bin < powers.size(); ++bin) {
        shown[bin] = 255 * (level_db(powers[bin]) + tvg(range_of(bin, state), a) + gain) / a.full_scale;
        if (echogram.rule == EchoRule::cerqueira2016) shown[bin] = 255 * powers[bin];
        largest = std::max(largest, shown[bin]);
    }
    const double scale = state.normalise && largest > 0 ? 255 / largest : 1;
    std::vector<std::uint8_t> points(shown.size());
    std::transform(shown.begin(), shown.end(), points.begin(), [&](double v) {
        return static_cast<std::uint8_t>(v > 0 ? std::min(255.0, std::round(v * scale)) : 0);
    });
    return points;
}

void follow(State& state, const Bottom& bottom, const std::vector<std::uint8_t>& points) {
    constexpr std::uint32_t step = 1000;  // mm
    const auto limited = [](std::uint32_t length) {
        return std::clamp(length, shortest_length, longest_length);
    };
    state.start = 0;
    if (bottom.confidence < 50) {
        state.length = limited(2 * state.length);
    } else if (bottom.distance > state.length / 5 * 4 || bottom.distance < state.length / 5 * 2) {
        state.length = limited((bottom.distance * 3 / 2 + step - 1) / step * step);
    }
    const int peak = points.empty() ? 0 : *std::max_element(points.begin(), points.end());
    if (peak > 240 && state.gain > 0) --state.gain;
    if (peak < 120 && state.gain + 1U < gain_factors.size()) ++state.gain;
}

}  // namespace echoloop::ping1d
