#include "emulator/devices/nmea-echosounder/bottom.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace echoloop::nmea_echosounder {
namespace {

/// Least power of a bottom; the paper's rule has neither power nor noise.
double least_power(const Echogram& echogram, double margin) {
    constexpr double least_of_paper = 0.05;
    if (echogram.rule == EchoRule::cerqueira2016) return least_of_paper;
    return echogram.noise_power * std::pow(10.0, margin / 10);
}

double edge_time(const Shot& shot, std::size_t bin) {
    return shot.first_bin_time + static_cast<double>(bin) * shot.bin_interval;
}

/// Power of each bin times the square of its time: 20 log R; 0 where noise or blanking may be the cause.
std::vector<double> strengths(const Echogram& echogram, const BottomRule& rule) {
    const auto beam = echogram.beam(0);
    const double least = least_power(echogram, rule.margin);
    std::vector<double> all(beam.size(), 0.0);
    for (std::size_t bin = 0; bin < beam.size(); ++bin) {
        const double time = edge_time(echogram.shot, bin);
        if (time >= rule.blanking && beam[bin] > least) all[bin] = beam[bin] * time * time;
    }
    return all;
}

}  // namespace

std::optional<double> bottom_time(const Echogram& echogram, const BottomRule& rule) {
    const auto strength = strengths(echogram, rule);
    const auto peak = std::max_element(strength.begin(), strength.end());
    if (peak == strength.end() || !(*peak > 0)) return std::nullopt;
    const double enough = *peak * std::pow(10.0, -rule.edge / 10);
    const auto edge = std::find_if(strength.begin(), peak, [&](double s) { return s >= enough; });
    return edge_time(echogram.shot, static_cast<std::size_t>(edge - strength.begin()));
}

}  // namespace echoloop::nmea_echosounder
