#include "render/acoustics/bin_filters.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace echoloop {
namespace {

constexpr std::size_t most_taps = 48;        ///< of a CW pulse; longer ones are boxes
constexpr std::size_t most_chirp_taps = 96;  ///< beyond, side lobes are left out

/// Mean intensity, over the bin that begins at offset `from`, of an echo of unit height.
double intensity(const PulseShape& pulse, double from, double bin_length) {
    return std::max(pulse.energy_until(from + bin_length) - pulse.energy_until(from), 0.0) / bin_length;
}

/// Mean over where in its bin the echo lies.
double even_intensity(const PulseShape& pulse, int bin, double bin_length) {
    constexpr int places = 32;
    double sum = 0;
    for (int i = 0; i < places; ++i)
        sum += intensity(pulse, (bin - (i + 0.5) / places) * bin_length, bin_length);
    return sum / places;
}

std::vector<float> scaled_to(double sum, const std::vector<double>& taps) {
    const double factor = sum / std::accumulate(taps.begin(), taps.end(), 0.0);
    std::vector<float> out;
    for (const double tap : taps) out.push_back(static_cast<float>(tap * factor));
    return out;
}

LineFilter unit_box(double length) {
    const double whole = std::floor(length), rest = length - whole;
    const auto scale = static_cast<float>(1 / std::sqrt(whole + rest * rest));
    return LineFilter::boxed(length, 1, 0, {scale});
}

std::vector<float> unit_energy(std::vector<double> taps) {
    const double energy = std::inner_product(taps.begin(), taps.end(), taps.begin(), 0.0);
    std::vector<float> out;
    for (const double tap : taps) out.push_back(static_cast<float>(tap / std::sqrt(energy)));
    return out;
}

}  // namespace

LineFilter power_filter(const PulseShape& pulse, double bin_length) {
    double begin = pulse.begin() / bin_length, end = pulse.end() / bin_length;
    if (!pulse.is_chirp() && end - begin > static_cast<double>(most_taps)) {
        const auto edge = static_cast<std::size_t>(std::max(1.0, std::round(pulse.edge() / bin_length)));
        return LineFilter::boxed(pulse.length() / bin_length, edge, 0, {0.5F, 0.5F});
    }
    if (end - begin > static_cast<double>(most_chirp_taps)) {
        begin = std::max(begin, std::min(pulse.main_begin() / bin_length, most_chirp_taps / -2.0));
        end = -begin;
    }
    const int first = static_cast<int>(std::floor(begin)), last = static_cast<int>(std::ceil(end));
    std::vector<double> taps;
    for (int k = first; k <= last; ++k) taps.push_back(even_intensity(pulse, k, bin_length));
    return {first, scaled_to(pulse.length() / bin_length, taps)};
}

LineFilter field_filter(const PulseShape& pulse, double bin_length) {
    const double span = (pulse.main_end() - pulse.main_begin()) / bin_length;
    if (span > static_cast<double>(most_taps)) return unit_box(pulse.length() / bin_length);
    std::vector<double> taps;
    for (int k = 0; k < span; ++k)
        taps.push_back(std::sqrt(intensity(pulse, pulse.main_begin() + k * bin_length, bin_length)));
    return {0, unit_energy(std::move(taps))};
}

/// Bins; noise that hardly changes over so many hardly changes at all.
constexpr double longest_box = 1e6;

LineFilter noise_filter(double bandwidth, double interval) {
    const double length = 1 / (bandwidth * interval);
    if (length <= 1) return {};
    if (length > static_cast<double>(most_taps)) return unit_box(std::min(length, longest_box));
    std::vector<double> taps(static_cast<std::size_t>(length), 1.0);
    if (const double rest = length - std::floor(length); rest > 0) taps.push_back(rest);
    return {0, unit_energy(std::move(taps))};
}

}  // namespace echoloop
