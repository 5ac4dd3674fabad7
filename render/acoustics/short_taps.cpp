#include "render/acoustics/short_taps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace echoloop {
namespace {

constexpr int most_steps = 20;
constexpr double near_enough = 1e-8;  ///< sum of squares of errors

/// Of taps, not divided by their energy.
double product_at(const std::vector<double>& taps, std::size_t lag) {
    return lag < taps.size() ? std::inner_product(taps.begin() + static_cast<std::ptrdiff_t>(lag), taps.end(),
                                                  taps.begin(), 0.0)
                             : 0;
}

/// Of a symmetrical positive definite matrix, row by row, by Cholesky's method; into `x`.
void solve(std::vector<double>& matrix, std::vector<double>& x) {
    const std::size_t n = x.size();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = matrix[i * n + j];
            for (std::size_t k = 0; k < j; ++k) sum -= matrix[i * n + k] * matrix[j * n + k];
            matrix[i * n + j] = i == j ? std::sqrt(sum) : sum / matrix[j * n + j];
        }
        for (std::size_t k = 0; k < i; ++k) x[i] -= matrix[i * n + k] * x[k];
        x[i] /= matrix[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) x[i] -= matrix[k * n + i] * x[k];
        x[i] /= matrix[i * n + i];
    }
}

class Fit {
  public:
    Fit(std::span<const double> correlation, std::size_t taps)
        : wanted_(correlation.begin(), correlation.begin() + static_cast<std::ptrdiff_t>(taps)), taps_(taps) {
        taps_[0] = 1;
        errors_ = errors_of(taps_);
        double damping = 0.01;
        for (int i = 0; i < most_steps && energy_of(errors_) > near_enough; ++i)
            damping *= step(damping) ? 0.1 : 10;
    }
    const std::vector<double>& taps() const { return taps_; }

  private:
    std::vector<double> errors_of(const std::vector<double>& taps) const {
        std::vector<double> out;
        for (std::size_t lag = 0; lag < wanted_.size(); ++lag)
            out.push_back(product_at(taps, lag) - wanted_[lag]);
        return out;
    }
    static double energy_of(const std::vector<double>& errors) {
        return std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0);
    }
    /// How the error at a lag changes with a tap.
    double slope(std::size_t lag, std::size_t tap) const {
        return (tap + lag < taps_.size() ? taps_[tap + lag] : 0) + (tap >= lag ? taps_[tap - lag] : 0);
    }
    /// False: it leads nowhere.
    bool step(double damping) {
        const std::size_t n = taps_.size();
        std::vector<double> matrix(n * n), next(n);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j <= i; ++j) {
                for (std::size_t lag = 0; lag < n; ++lag) matrix[i * n + j] += slope(lag, i) * slope(lag, j);
            }
            matrix[i * n + i] += damping;
            for (std::size_t lag = 0; lag < n; ++lag) next[i] -= slope(lag, i) * errors_[lag];
        }
        solve(matrix, next);
        for (std::size_t i = 0; i < n; ++i) next[i] += taps_[i];
        std::vector<double> errors = errors_of(next);
        if (!(energy_of(errors) < energy_of(errors_))) return false;
        taps_ = std::move(next), errors_ = std::move(errors);
        return true;
    }

    std::vector<double> wanted_, taps_, errors_;
};

double greatest_error(const std::vector<double>& taps, std::span<const double> correlation) {
    double greatest = 0;
    for (std::size_t lag = 1; lag < correlation.size(); ++lag)
        greatest =
            std::max(greatest, std::abs(product_at(taps, lag) / product_at(taps, 0) - correlation[lag]));
    return greatest;
}

}  // namespace

std::vector<double> short_taps(std::span<const double> correlation) {
    // Rounded, so that the steps, which may make much of little, are the same on every processor.
    std::vector<double> wanted;
    for (const double value : correlation) wanted.push_back(std::round(value * 0x1p24) * 0x1p-24);
    std::size_t count = wanted.size();
    while (count > 1 && std::abs(wanted[count - 1]) < taps_error) --count;
    std::vector<double> taps = Fit(wanted, count).taps();
    while (greatest_error(taps, wanted) > taps_error && count < wanted.size())
        taps = Fit(wanted, ++count).taps();
    const double scale = 1 / std::sqrt(product_at(taps, 0));
    for (double& tap : taps) tap *= scale;
    return taps;
}

}  // namespace echoloop
