#include "emulator/devices/imagenex-deltat/smoothing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace echoloop::delta_t {
namespace {

constexpr double tolerance = 0.03;  // of the range
constexpr double least_points = 3;
constexpr double edge = 3;  // times what is missing beyond the fan

/// Of a beam: cosine and sine of its angle.
struct Direction {
    double down = 0, across = 0;
};

/// A straight bottom: down cos(angle) + across sin(angle) = 1 / range.
struct Line {
    double down = 0, across = 0;
    double range(Direction d) const { return 1 / (down * d.down + across * d.across); }
};

/// Sums of a least-squares fit, weighted so that errors of long and short ranges count by their proportion.
class Fit {
  public:
    void add(double range, Direction d) {
        const double c = range * d.down, s = range * d.across;
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

bool is_on(const Line& line, double range, Direction direction) {
    return std::abs(line.range(direction) / range - 1) < tolerance;
}

/// The beams [from, to) and the line through their points; `scatter`: root mean square, parts of the range.
struct Window {
    std::size_t from = 0, to = 0;
    Line line;
    double scatter = std::numeric_limits<double>::infinity();
};

class Smoother {
  public:
    Smoother(std::span<const double> ranges, std::span<const double> angles)
        : ranges_(ranges), angles_(angles) {
        for (const double angle : angles) directions_.push_back({std::cos(angle), std::sin(angle)});
    }

    /// The range of `beam` on the line through the points from `first` to `last` rad around it; beside a
    /// step or a bend, on that through as many more on its better side.
    double range(std::size_t beam, double first, double last) const {
        // A line is surest in its middle: by so much less at a quarter of it and at its end, but the more the
        // longer it is.
        struct Side {
            double place, length, unsure;
        };
        constexpr Side sides[] = {{0.25, 1, 2}, {0.75, 1, 2}, {0, 1, 2.7},
                                  {1, 1, 2.7},  {0, 1.6, 2},  {1, 1.6, 2}};
        const double angle = angles_[beam], width = last - first;
        Window best = window(first, last);
        double error = best.scatter;
        const std::size_t least = (best.to - best.from) * 9 / 10;  // the fan ends there otherwise
        for (const auto& [place, length, unsure] : sides) {
            const Window side = window(angle - place * length * width, angle + (1 - place) * length * width);
            if (side.to - side.from >= least && unsure * side.scatter < error)
                best = side, error = unsure * side.scatter;
        }
        return refined(best, beam);
    }

  private:
    Window window(double first, double last) const {
        Window w;
        w.from = index(std::lower_bound(angles_.begin(), angles_.end(), first));
        w.to = index(std::upper_bound(angles_.begin(), angles_.end(), last));
        Fit all;
        for (std::size_t i = w.from; i < w.to; ++i)
            if (ranges_[i] > 0) all.add(ranges_[i], directions_[i]);
        if (!all.solve(w.line)) return w;
        double squares = 0, points = 0;
        for (std::size_t i = w.from; i < w.to; ++i) {
            if (!(ranges_[i] > 0)) continue;
            const double off = w.line.range(directions_[i]) / ranges_[i] - 1;
            squares += off * off;
            ++points;
        }
        w.scatter = std::sqrt(squares / points);
        return w;
    }
    /// Once more, without the points that are off the line; a point that is itself off stays where it is.
    double refined(const Window& w, std::size_t beam) const {
        Fit near;
        Line line = w.line;
        if (!std::isfinite(w.scatter) || !is_on(line, ranges_[beam], directions_[beam])) return ranges_[beam];
        for (std::size_t i = w.from; i < w.to; ++i)
            if (ranges_[i] > 0 && is_on(w.line, ranges_[i], directions_[i]))
                near.add(ranges_[i], directions_[i]);
        if (!near.solve(line) || !is_on(line, ranges_[beam], directions_[beam])) return ranges_[beam];
        return line.range(directions_[beam]);
    }
    std::size_t index(std::span<const double>::iterator at) const {
        return static_cast<std::size_t>(at - angles_.begin());
    }

    std::span<const double> ranges_, angles_;
    std::vector<Direction> directions_;
};

}  // namespace

std::vector<double> smoothed(std::span<const double> ranges, std::span<const double> angles, double reach) {
    std::vector<double> out(ranges.begin(), ranges.end());
    const Smoother smoother(ranges, angles);
    for (std::size_t n = 0; n < out.size(); ++n) {
        // Where the fan ends on one side, the line goes on for four times as much on the other, since its end
        // is its least sure part.
        const double beyond_last = std::max(0.0, angles[n] + reach - angles.back());
        const double beyond_first = std::max(0.0, angles.front() - angles[n] + reach);
        const double first = angles[n] - reach - edge * beyond_last;
        const double last = angles[n] + reach + edge * beyond_first;
        if (ranges[n] > 0) out[n] = smoother.range(n, first, last);
    }
    return out;
}

}  // namespace echoloop::delta_t
