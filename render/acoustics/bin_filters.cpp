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

}  // namespace echoloop
