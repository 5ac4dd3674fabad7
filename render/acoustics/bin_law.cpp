#include "render/acoustics/bin_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace echoloop {
namespace {

constexpr double law_end = 5.2;  ///< standard deviations, to which the polynomial is made

/// Of a normal variable, the share below z.
double below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// The regularised incomplete gamma functions P(a, x) and Q(a, x) = 1 - P, by the series and the continued
/// fraction of Abramowitz & Stegun, 6.5.29 and 6.5.31.
struct GammaShares {
    double lower, upper;
};

GammaShares gamma_shares(double a, double x) {
    if (x <= 0) return {0, 1};
    int sign = 1;  // std::lgamma would write it where all threads do
    const double front = std::exp(a * std::log(x) - x - ::lgamma_r(a, &sign));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (double n = a + 1; term > sum * 1e-15; ++n) sum += term *= x / n;
        return {front * sum, 1 - front * sum};
    }
    double b = x + 1 - a, c = 1e300, d = 1 / b, fraction = d;
    for (int i = 1; i < 1000; ++i) {
        const double step = -i * (i - a);
        b += 2;
        d = 1 / (step * d + b);
        c = b + step / c;
        fraction *= c * d;
        if (std::abs(c * d - 1) < 1e-14) break;
    }
    return {1 - front * fraction, front * fraction};
}

/// Of a gamma variable of this shape and mean 1, the value that is exceeded as z is.
double gamma_quantile(double shape, double z) {
    double low = 0, high = 60 + 60 / shape;
    for (int i = 0; i < 80; ++i) {
        const double middle = (low + high) / 2;
        const GammaShares shares = gamma_shares(shape, shape * middle);
        const bool more = z < 0 ? shares.lower < below(z) : shares.upper > below(-z);
        (more ? low : high) = middle;
    }
    return (low + high) / 2;
}

/// The same of the greatest of `looks` exponential variables of mean 1.
double peak_quantile(double looks, double z) {
    const double log_share = z < 0 ? std::log(below(z)) : std::log1p(-below(-z));
    return -std::log(-std::expm1(log_share / looks));
}

/// Mean of the cube of a polynomial in a normal variable.
double mean_of(std::span<const double> root) {
    double sum = 0, weights = 0;
    for (double z = -law_end; z < law_end; z += 1.0 / 64) {
        double value = 0;
        for (std::size_t k = root.size(); k-- > 0;) value = value * z + root[k];
        const double weight = std::exp(-z * z / 2), positive = std::max(value, 0.0);
        sum += weight * positive * positive * positive, weights += weight;
    }
    return sum / weights;
}

/// The polynomial through the cube roots at Chebyshev's nodes, of that mean.
template <typename Quantile>
BinLaw law_of(const Quantile& quantile, double mean) {
    constexpr std::size_t n = BinLaw::terms;
    std::array<double, n> node, difference, sum{};
    for (std::size_t i = 0; i < n; ++i) {
        node[i] = law_end * std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / n);
        difference[i] = std::cbrt(quantile(node[i]));
    }
    for (std::size_t order = 1; order < n; ++order)  // Newton's divided differences
        for (std::size_t i = n - 1; i >= order; --i)
            difference[i] = (difference[i] - difference[i - 1]) / (node[i] - node[i - order]);
    for (std::size_t i = n; i-- > 0;) {  // sum = sum * (z - node) + difference
        for (std::size_t k = n - 1; k > 0; --k) sum[k] = sum[k - 1] - node[i] * sum[k];
        sum[0] = difference[i] - node[i] * sum[0];
    }
    BinLaw law;
    law.mean = mean;
    const double scale = std::cbrt(mean / mean_of(sum));
    std::transform(sum.begin(), sum.end(), law.root.begin(),
                   [&](double c) { return static_cast<float>(c * scale); });
    return law;
}

/// 1 + 1/2 + ... + 1/n, between whole numbers, too: psi(n + 1) + Euler's constant.
double harmonic(double n) {
    double sum = 0;
    for (; n < 20; ++n) sum -= 1 / (n + 1);
    const double x = n + 1;
    return sum + std::log(x) - 1 / (2 * x) - 1 / (12 * x * x) + std::numbers::egamma;
}

}  // namespace

BinLaw gamma_law(double shape) {
    return law_of([&](double z) { return gamma_quantile(shape, z); }, 1);
}

BinLaw bin_law(BinRule rule, double looks) {
    if (rule != BinRule::peak) return gamma_law(rule == BinRule::mean ? looks : 1);
    return law_of([&](double z) { return peak_quantile(looks, z); }, harmonic(looks));
}

double looks_in(const RangeCorrelation& correlation, double bin_length) {
    constexpr int steps = 4096;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double u = (i + 0.5) / steps;
        sum += 2 * (1 - u) * correlation(u * bin_length) / steps;
    }
    return std::max(1.0, 1 / sum);
}

}  // namespace echoloop
