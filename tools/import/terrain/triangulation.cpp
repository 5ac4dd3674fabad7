#include "tools/import/terrain/triangulation.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>
#include <queue>

#include "tools/import/terrain/delaunay.h"

namespace echoloop::worlds {
namespace {

std::int64_t floor_of(std::int64_t a, std::int64_t b) {  // b > 0
    const std::int64_t q = a / b;
    return q * b > a ? q - 1 : q;
}

/// One side of a triangle from the lower to the higher end: where rows cross it.
struct Side {
    GridPoint low, high;
    std::int64_t floor_at(std::int32_t y) const {
        return low.x + floor_of(std::int64_t{high.x - low.x} * (y - low.y), high.y - low.y);
    }
    std::int64_t ceiling_at(std::int32_t y) const {
        return low.x - floor_of(std::int64_t{low.x - high.x} * (y - low.y), high.y - low.y);
    }
};

struct Plane {
    double at_origin, per_column, per_row;
};

Plane plane_through(const Heights& heights, const std::array<GridPoint, 3>& p) {
    const double z = heights.at(p[0]);
    const double x1 = p[1].x - p[0].x, y1 = p[1].y - p[0].y, z1 = heights.at(p[1]) - z;
    const double x2 = p[2].x - p[0].x, y2 = p[2].y - p[0].y, z2 = heights.at(p[2]) - z;
    const double area = x1 * y2 - x2 * y1;
    const double per_column = (z1 * y2 - z2 * y1) / area, per_row = (x1 * z2 - x2 * z1) / area;
    return {z - per_column * p[0].x - per_row * p[0].y, per_column, per_row};
}

struct Worst {
    float error = 0;
    GridPoint where;
};

/// The sample in the triangle, its edge included, that is farthest above or below it.
Worst worst_in(const Heights& heights, std::array<GridPoint, 3> p) {
    const Plane plane = plane_through(heights, p);
    std::ranges::sort(p, {}, &GridPoint::y);
    const Side whole{p[0], p[2]}, lower{p[0], p[1]}, upper{p[1], p[2]};
    const bool to_the_right =
        std::int64_t{p[1].x - p[0].x} * (p[2].y - p[0].y) > std::int64_t{p[2].x - p[0].x} * (p[1].y - p[0].y);
    Worst worst;
    for (std::int32_t y = p[0].y; y <= p[2].y; ++y) {
        const Side& broken = y > p[1].y || p[0].y == p[1].y ? upper : lower;
        const auto first = static_cast<std::int32_t>((to_the_right ? whole : broken).ceiling_at(y));
        const auto last = static_cast<std::int32_t>((to_the_right ? broken : whole).floor_at(y));
        if (first > last) continue;
        const float* const row =
            &heights.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(heights.width)];
        const double begin = plane.at_origin + plane.per_row * y;
        for (std::int32_t x = first; x <= last; ++x) {
            const auto off = static_cast<float>(std::abs(row[x] - (begin + plane.per_column * x)));
            if (off > worst.error) worst = {off, {x, y}};  // never where the sample is no number
        }
    }
    return worst;
}

/// What a triangle is for: its place in the queue counts while it is the same triangle.
struct Candidate {
    float error;
    std::uint32_t triangle, version;
    GridPoint where;
    bool operator<(const Candidate& other) const {
        return error != other.error ? error < other.error : triangle > other.triangle;
    }
};

class Refining {
  public:
    Refining(Heights& heights, const TriangulationRules& rules)
        : heights_(heights), rules_(rules), mesh_(heights.width, heights.height) {}

    Triangulation run() {
        Triangulation out;
        out.lone = leave_out_lone();
        for (const GridPoint p : needed_corners())
            if (mesh_.insert(p, near_)) near_ = mesh_.changed().front();
        for (std::uint32_t t = 0; t < mesh_.size(); ++t) kept_ += solid(t);
        out.needed = kept_;
        if (kept_ > rules_.most) return out;
        versions_.resize(mesh_.size());
        for (std::uint32_t t = 0; t < mesh_.size(); ++t) judge(t);
        refine();
        out.error = queue_.empty() ? within_ : std::max(within_, queue_.top().error);
        collect(out);
        return out;
    }

  private:
    std::size_t leave_out_lone() {
        std::size_t lone = 0;
        for_all([&](GridPoint p) {
            if (!heights_.known(p) || cells_around(p, true) > 0) return;
            heights_.at(p) = std::numeric_limits<float>::quiet_NaN();
            ++lone;
        });
        return lone;
    }

    template <class F>
    void for_all(const F& f) const {
        for (std::int32_t y = 0; y < heights_.height; ++y)
            for (std::int32_t x = 0; x < heights_.width; ++x) f(GridPoint{x, y});
    }

    /// How many of the cells around a sample are solid, or are not.
    int cells_around(GridPoint p, bool are_solid) const {
        int count = 0;
        for (std::int32_t y = std::max(p.y - 1, 0); y <= std::min(p.y, heights_.height - 2); ++y)
            for (std::int32_t x = std::max(p.x - 1, 0); x <= std::min(p.x, heights_.width - 2); ++x)
                count += heights_.solid({x, y}) == are_solid;
        return count;
    }

    /// Of a lattice; and all at holes, so that a hole's edge, which joins neighbouring samples, is an edge of
    /// triangles: no other sample is in the circle on it. The coarse ones come first, for short walks.
    std::vector<GridPoint> needed_corners() const {
        std::vector<GridPoint> out;
        for_all([&](GridPoint p) {
            if (!heights_.known(p)) return;
            const bool of_lattice =
                rules_.lattice > 0 && p.x % rules_.lattice == 0 && p.y % rules_.lattice == 0;
            if (of_lattice || cells_around(p, false) > 0) out.push_back(p);
        });
        std::ranges::stable_sort(out, std::greater(), [](GridPoint p) {
            return std::countr_zero(static_cast<std::uint32_t>(p.x | p.y));
        });
        return out;
    }

    std::array<GridPoint, 3> points_of(std::uint32_t t) const {
        const auto [a, b, c] = mesh_.triangle(t);
        return {mesh_.points()[a], mesh_.points()[b], mesh_.points()[c]};
    }

    /// A triangle lies in solid cells only or in holes only, so the cell of its middle tells.
    bool solid(std::uint32_t t) const {
        const auto [a, b, c] = points_of(t);
        return heights_.solid({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3});
    }

    void judge(std::uint32_t t) {
        ++versions_[t];
        if (!solid(t)) return;
        const Worst worst = worst_in(heights_, points_of(t));
        if (worst.error > rules_.error)
            queue_.push({worst.error, t, versions_[t], worst.where});
        else
            within_ = std::max(within_, worst.error);
    }

    /// The error falls about as the number of triangles rises.
    double share_done(double worst) const {
        return std::clamp(
            std::max(rules_.error / worst, static_cast<double>(kept_) / static_cast<double>(rules_.most)),
            0.0, 1.0);
    }

    void refine() {
        for (std::size_t step = 0; !queue_.empty(); ++step) {
            const Candidate worst = queue_.top();
            if (versions_[worst.triangle] != worst.version) {
                queue_.pop();
                continue;
            }
            if (kept_ + 2 > rules_.most) return;
            if (rules_.told && step % 1024 == 0) rules_.told(share_done(worst.error));
            queue_.pop();
            const std::uint32_t before = mesh_.size();
            if (!mesh_.insert(worst.where, worst.triangle)) continue;
            kept_ += mesh_.size() - before;
            versions_.resize(mesh_.size());
            for (const std::uint32_t t : mesh_.changed()) judge(t);
        }
    }

    void collect(Triangulation& out) const {
        constexpr std::uint32_t unused = ~std::uint32_t{0};
        std::vector<std::uint32_t> number(mesh_.points().size(), unused);
        for (std::uint32_t t = 0; t < mesh_.size(); ++t) {
            if (!solid(t)) continue;
            auto corners = mesh_.triangle(t);
            for (auto& corner : corners) {
                if (number[corner] == unused) {
                    number[corner] = static_cast<std::uint32_t>(out.corners.size());
                    out.corners.push_back(mesh_.points()[corner]);
                }
                corner = number[corner];
            }
            out.triangles.push_back(corners);
        }
    }

    Heights& heights_;
    const TriangulationRules& rules_;
    GridDelaunay mesh_;
    std::uint32_t near_ = 0;
    std::size_t kept_ = 0;  ///< triangles that are no holes
    std::vector<std::uint32_t> versions_;
    std::priority_queue<Candidate> queue_;
    float within_ = 0;  ///< m, the largest error that was let be
};

}  // namespace

Triangulation triangulate(Heights& heights, const TriangulationRules& rules) {
    return Refining(heights, rules).run();
}

}  // namespace echoloop::worlds
