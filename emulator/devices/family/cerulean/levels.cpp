#include "emulator/devices/family/cerulean/levels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace echoloop::cerulean_device {
namespace {

constexpr double widest_span = 90;  // dB
constexpr double headroom = 6;      // dB
constexpr float clipped = 0.9F;     // of full scale, in power

double strongest(std::span<const float> powers) {
    return powers.empty() ? 0 : *std::max_element(powers.begin(), powers.end());
}

}  // namespace

Results to_results(std::span<const float> powers, double full_scale) {
    constexpr double silence = -200;  // dB, for a ping without a sound
    constexpr double steps = 65535;
    const double peak = strongest(powers);
    const double top = peak > 0 ? 10 * std::log10(peak) - full_scale : silence;
    std::vector<double> levels(powers.size());
    std::transform(powers.begin(), powers.end(), levels.begin(), [&](float power) {
        const double level = power > 0 ? level_db(power) - full_scale : silence;
        return std::clamp(level, top - widest_span, top);
    });
    const double low = levels.empty() ? top : *std::min_element(levels.begin(), levels.end());
    Results results;
    results.max_db = static_cast<float>(top > low ? top : low + widest_span);  // hosts divide by the span
    results.min_db = static_cast<float>(low);
    results.values.resize(levels.size());
    const double scale = top > low ? steps / (top - low) : 0;
    std::transform(levels.begin(), levels.end(), results.values.begin(), [&](double level) {
        return static_cast<std::uint16_t>(std::lround((level - low) * scale));
    });
    return results;
}

std::vector<float> smoothed(std::span<const float> powers, std::size_t bins) {
    std::vector<float> out(powers.begin(), powers.end());
    if (bins < 2) return out;
    const std::size_t before = (bins - 1) / 2;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::size_t from = i < before ? 0 : i - before;
        const std::size_t to = std::min(powers.size(), i - std::min(i, before) + bins);
        const auto part = powers.subspan(from, to - from);
        out[i] = std::accumulate(part.begin(), part.end(), 0.0F) / static_cast<float>(part.size());
    }
    return out;
}

std::vector<double> full_scales(double lowest, std::span<const double> gains) {
    std::vector<double> all;
    for (const double gain : gains) all.push_back(lowest - 20 * std::log10(gain / gains.front()));
    return all;
}

std::size_t fitting_gain(std::span<const float> powers, std::span<const double> scales,
                         std::size_t heard_with) {
    const double peak = strongest(powers);
    if (!(peak > 0)) return scales.size() - 1;
    const double level = 10 * std::log10(peak);
    std::size_t gain = scales.size() - 1;
    while (gain > 0 && level > scales[gain] - headroom) --gain;
    const bool clips = peak > clipped * std::pow(10.0, scales[heard_with] / 10);
    return clips && heard_with > 0 ? std::min(gain, heard_with - 1) : gain;
}

double compass(Vec3 direction) {
    const double heading = rad_to_deg(std::atan2(direction.x, direction.y));
    return std::hypot(direction.x, direction.y) < 1e-6 ? 0 : std::fmod(heading + 360, 360);
}

}  // namespace echoloop::cerulean_device
