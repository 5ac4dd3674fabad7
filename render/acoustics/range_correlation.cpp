#include "render/acoustics/range_correlation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "render/acoustics/chain.h"
#include "render/acoustics/short_taps.h"
#include "render/acoustics/sinc.h"

namespace echoloop {
namespace {

constexpr std::size_t most_lags = 16;
constexpr double nothing = 2e-3;
constexpr double longest_box = 1e6;  ///< bins; what hardly changes over so many hardly changes at all

double of_box(double x) { return x < 1 ? (1 - x) * (1 - x) : 0; }

/// Of a chirp with Hamming weights over its band: the transform of their square at x resolutions.
double of_chirp(double x) {
    constexpr double a = 0.54, b = 0.46;
    const double u = x / chirp_stretch;
    const double r = (a * a + b * b / 2) * sinc(u) + a * b * (sinc(u - 1) + sinc(u + 1)) +
                     b * b / 4 * (sinc(u - 2) + sinc(u + 2));
    return std::pow(r / (a * a + b * b / 2), 2);
}

/// Of means over bins that lie `lag` bins apart, not divided by the variance.
double of_means(const RangeCorrelation& correlation, double lag, double bin_length) {
    constexpr int steps = 256;
    double sum = 0;
    for (int i = -steps; i < steps; ++i) {
        const double u = (i + 0.5) / steps;
        sum += (1 - std::abs(u)) * correlation(std::abs(lag + u) * bin_length) / steps;
    }
    return sum;
}

/// The correlation at all lags until nothing is left of it; lag 0 first.
std::vector<double> over_bins(const RangeCorrelation& correlation, BinRule rule, double bin_length) {
    std::vector<double> out;
    double last = 1;
    for (std::size_t lag = 0; lag <= most_lags + 1; ++lag) {
        const auto at = static_cast<double>(lag);
        out.push_back(rule == BinRule::sample ? correlation(at * bin_length)
                                              : of_means(correlation, at, bin_length));
        const double now = out.back() / out.front();
        if (lag > 0 && now < nothing && last < nothing) break;
        last = now;
    }
    const double variance = out.front();
    for (double& value : out) value /= variance;
    return out;
}

/// m over which it falls to a quarter.
double quarter(const RangeCorrelation& correlation, double bin_length) {
    double x = bin_length;
    while (x < longest_box * bin_length && correlation(x) > 0.25) x *= 1.02;
    return x;
}

std::vector<float> unit_energy(const std::vector<double>& taps) {
    const double energy = std::inner_product(taps.begin(), taps.end(), taps.begin(), 0.0);
    std::vector<float> out;
    for (const double tap : taps) out.push_back(static_cast<float>(tap / std::sqrt(energy)));
    return out;
}

LineFilter unit_box(double length) {
    const double whole = std::floor(length), rest = length - whole;
    const auto scale = static_cast<float>(1 / std::sqrt(whole + rest * rest));
    return LineFilter::boxed(length, 1, 0, {scale});
}

}  // namespace

RangeCorrelation noise_correlation(const Shot& shot, double sound_speed) {
    if (shot.bandwidth == 0 && shot.receiver.bandwidth > 0)
        return [scale = 2 * shot.receiver.bandwidth / sound_speed](double x) {
            return std::pow(sinc(x * scale), 2);
        };
    const double length = range_resolution(shot, sound_speed);
    if (shot.bandwidth > 0) return [length](double x) { return of_chirp(x / length); };
    return [length](double x) { return of_box(x / length); };
}

RangeCorrelation echo_correlation(const Shot& shot, double sound_speed) {
    const double length = range_resolution(shot, sound_speed), band = shot.receiver.bandwidth;
    if (shot.bandwidth == 0 && band > 0 && sound_speed / 2 / band > length)
        return noise_correlation(shot, sound_speed);
    Shot matched = shot;
    matched.receiver.bandwidth = 0;
    return noise_correlation(matched, sound_speed);
}

double normal_correlation(double intensity, double looks) {
    return intensity * (1 + 0.2 * (1 - intensity) / looks);
}

LineFilter bin_filter(const RangeCorrelation& correlation, BinRule rule, double looks, double bin_length) {
    std::vector<double> over = over_bins(correlation, rule, bin_length);
    // (1 - x / d)^2 is a quarter at d / 2, a box of 2/3 d there, too.
    if (over.size() > most_lags + 1)
        return unit_box(std::min(quarter(correlation, bin_length) * 4 / 3 / bin_length, longest_box));
    for (double& value : over) value = normal_correlation(value, looks);
    const std::vector<double> taps = short_taps(over);
    return taps.size() > 1 ? LineFilter(0, unit_energy(taps)) : LineFilter();
}

LineFilter tuned_filter(double bandwidth, double sound_speed, double bin_length) {
    const double left = std::exp(-2 * std::numbers::pi * bandwidth * 2 * bin_length / sound_speed);
    std::vector<double> taps;
    for (double tap = 1; tap > 0.02; tap *= left) taps.push_back(tap);
    return {0, unit_energy(taps)};
}

double neighbour_correlation(const LineFilter& filter) {
    if (filter.is_identity()) return 0;
    std::vector<float> impulse(filter.room(4 * filter.before() + 4), 0.0F), scratch;
    const std::size_t count = 2 * filter.before() + 2;
    impulse[filter.before()] = 1;
    std::vector<float> answer(count);
    filter.apply(impulse, count, answer.data(), scratch);
    double energy = 0, cross = 0;
    for (std::size_t i = 0; i < count; ++i) {
        energy += static_cast<double>(answer[i]) * static_cast<double>(answer[i]);
        if (i > 0) cross += static_cast<double>(answer[i]) * static_cast<double>(answer[i - 1]);
    }
    return cross / energy;
}

}  // namespace echoloop
