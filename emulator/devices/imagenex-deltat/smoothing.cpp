#include "emulator/devices/imagenex-deltat/smoothing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace echoloop::delta_t {
namespace {

constexpr double tolerance = 0.03;  // of the range
constexpr double least_points = 3;

/// A straight bottom: along cos(angle) + across sin(angle) = 1 / range.
struct Line {
    double down = 0, across = 0;
    double range(double angle) const { return 1 / (down * std::cos(angle) + across * std::sin(angle)); }
};

/// Sums of a least-squares fit, weighted so that errors of long and short ranges count by their proportion.
class Fit {
  public:
    void add(double range, double angle) {
        const double c = range * std::cos(angle), s = range * std::sin(angle);
        cc_ += c * c, ss_ += s * s, cs_ += c * s, c_ += c, s_ += s;
        ++points_;
    }
    /// False where the points make no line.
    bool solve(Line& line) const {
        const double determinant = cc_ * ss_ - cs_ * cs_;
        if (points_ < least_points || !(determinant > 1e-12 * cc_ * cc_)) return false;
        line = {(c_ * ss_ - s_ * cs_) / determinant, (s_ * cc_ - c_ * cs_) / determinant};
        return true;
    }

  private:
    double cc_ = 0, ss_ = 0, cs_ = 0, c_ = 0, s_ = 0, points_ = 0;
};

bool is_on(const Line& line, double range, double angle) {
    return std::abs(line.range(angle) / range - 1) < tolerance;
}

double fitted(std::span<const double> ranges, std::span<const double> angles, std::size_t from,
              std::size_t to, std::size_t own) {
    Fit all, near;
    Line line;
    for (std::size_t i = from; i < to; ++i)
        if (ranges[i] > 0) all.add(ranges[i], angles[i]);
    if (!all.solve(line) || !is_on(line, ranges[own], angles[own])) return ranges[own];
    for (std::size_t i = from; i < to; ++i)
        if (ranges[i] > 0 && is_on(line, ranges[i], angles[i])) near.add(ranges[i], angles[i]);
    if (!near.solve(line) || !is_on(line, ranges[own], angles[own])) return ranges[own];
    return line.range(angles[own]);
}

}  // namespace

std::vector<double> smoothed(std::span<const double> ranges, std::span<const double> angles, double reach) {
    std::vector<double> out(ranges.begin(), ranges.end());
    std::size_t from = 0, to = 0;
    for (std::size_t n = 0; n < out.size(); ++n) {
        // As wide at the edges of the fan as in its middle, since a line's end is its least sure part.
        const double first = std::min(angles[n] - reach, angles.back() - 2 * reach);
        const double last = std::max(angles[n] + reach, angles.front() + 2 * reach);
        while (from < n && angles[from] < first) ++from;
        while (to < out.size() && angles[to] <= last) ++to;
        if (ranges[n] > 0) out[n] = fitted(ranges, angles, from, to, n);
    }
    return out;
}

}  // namespace echoloop::delta_t
