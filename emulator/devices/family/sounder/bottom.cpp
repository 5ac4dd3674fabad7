#include "emulator/devices/family/sounder/bottom.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "emulator/devices/family/sounder/water.h"

namespace echoloop::echosounder {
namespace {

constexpr double silence = -std::numeric_limits<double>::infinity();

/// Least power of an echo; the paper's rule has neither power nor noise.
double least_power(const Echogram& echogram, double noise, double margin) {
    constexpr double least_of_paper = 0.05;
    if (echogram.rule == EchoRule::cerqueira2016 && std::isfinite(margin)) return least_of_paper;
    return noise * std::pow(10.0, margin / 10);
}

/// dB of each bin with spreading and absorption given back; silence where it can be no echo.
std::vector<double> strengths(const Echogram& echogram, std::size_t beam, double least,
                              const BottomRule& rule) {
    const auto powers = echogram.beam(beam);
    std::vector<double> all(powers.size(), silence);
    for (std::size_t bin = 0; bin < powers.size(); ++bin) {
        const double time = bin_time(echogram.shot, static_cast<double>(bin));
        if (time < rule.blanking || !(powers[bin] > least)) continue;
        const double middle = time + echogram.shot.bin_interval / 2;
        all[bin] = level_db(powers[bin]) + rule.spreading * std::log10(middle) + rule.absorption * middle;
    }
    return all;
}

}  // namespace

double background(const Echogram& echogram, std::size_t beam) {
    constexpr double quarter_of_noise =
        0.288;  // of the mean, where an exponential distribution has a quarter
    const auto powers = echogram.beam(beam);
    if (powers.empty()) return echogram.noise_power;
    std::vector<float> sorted(powers.begin(), powers.end());
    const auto quarter = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 4);
    std::nth_element(sorted.begin(), quarter, sorted.end());
    return std::max(echogram.noise_power, *quarter / quarter_of_noise);
}

std::optional<Bottom> find_bottom(const Echogram& echogram, const BottomRule& rule, std::size_t beam) {
    const double noise = background(echogram, beam);
    const auto strength = strengths(echogram, beam, least_power(echogram, noise, rule.margin), rule);
    const auto peak = std::max_element(strength.begin(), strength.end());
    if (peak == strength.end() || *peak == silence) return std::nullopt;
    const auto strongest = static_cast<std::size_t>(peak - strength.begin());
    const double power = echogram.beam(beam)[strongest];
    if (std::isfinite(rule.margin) && !stands_out_of_water(echogram, beam, strongest, power, bin_margin))
        return std::nullopt;
    const auto edge = std::find_if(strength.begin(), peak, [&](double s) { return s >= *peak - rule.edge; });
    return Bottom{static_cast<std::size_t>(edge - strength.begin()),
                  level_db(echogram.beam(beam)[strongest]) - 10 * std::log10(noise)};
}

}  // namespace echoloop::echosounder
