#include "tests/render/acoustics/statistics.h"

#include <algorithm>
#include <cmath>

namespace echoloop {
namespace {

template <typename Value>
double mean_of(std::span<const float> x, const Value& value) {
    double sum = 0;
    for (const float v : x) sum += value(static_cast<double>(v));
    return sum / static_cast<double>(x.size());
}

double distance_from_exponential(std::span<const float> x, double mean) {
    std::vector<float> sorted(x.begin(), x.end());
    std::sort(sorted.begin(), sorted.end());
    double largest = 0;
    const auto n = static_cast<double>(sorted.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const double expected = 1 - std::exp(-static_cast<double>(sorted[i]) / mean),
                     at = static_cast<double>(i);
        largest = std::max({largest, expected - at / n, (at + 1) / n - expected});
    }
    return largest;
}

}  // namespace

IntensityStatistics intensity_statistics(std::span<const float> x) {
    IntensityStatistics out;
    out.mean = mean_of(x, [](double i) { return i; });
    const double amplitude = mean_of(x, [](double i) { return std::sqrt(i); });
    out.amplitude_cv = std::sqrt(out.mean - amplitude * amplitude) / amplitude;
    const double variance = mean_of(x, [&](double i) { return (i - out.mean) * (i - out.mean); });
    out.scintillation = variance / (out.mean * out.mean);
    out.skewness = mean_of(x, [&](double i) { return std::pow(i - out.mean, 3); }) / std::pow(variance, 1.5);
    const double db = mean_of(x, [](double i) { return 10 * std::log10(i); });
    out.db_deviation = std::sqrt(mean_of(x, [&](double i) { return std::pow(10 * std::log10(i) - db, 2); }));
    out.db_offset = db - 10 * std::log10(out.mean);
    out.kolmogorov = distance_from_exponential(x, out.mean);
    out.kolmogorov_limit = 1.63 / std::sqrt(static_cast<double>(x.size()));
    return out;
}

double correlation(std::span<const float> a, std::span<const float> b) {
    const double ma = mean_of(a, [](double i) { return i; }), mb = mean_of(b, [](double i) { return i; });
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double x = static_cast<double>(a[i]) - ma, y = static_cast<double>(b[i]) - mb;
        ab += x * y, aa += x * x, bb += y * y;
    }
    return ab / std::sqrt(aa * bb);
}

}  // namespace echoloop
