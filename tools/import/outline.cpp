#include "tools/import/outline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "render/scene/limits.h"

namespace echoloop::worlds {
namespace {

using Point = std::array<double, 2>;
constexpr std::size_t most_corners = 1000;

struct Edge {
    Point from, to;
    double x_at(double y) const { return from[0] + (to[0] - from[0]) * (y - from[1]) / (to[1] - from[1]); }
    bool is_level() const { return from[1] == to[1]; }
    bool spans(double low, double high) const {
        return std::min(from[1], to[1]) <= low && std::max(from[1], to[1]) >= high;
    }
};

std::vector<Edge> edges_of(const std::vector<Outline>& outlines) {
    std::vector<Edge> out;
    for (const Outline& outline : outlines) {
        std::size_t corners = 0;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const Edge edge{outline[i], outline[(i + 1) % outline.size()]};
            for (const double value : edge.from)
                if (!(std::abs(value) <= scene_limits::extent))
                    throw std::runtime_error("has a corner beyond 100 km");
            if (edge.from != edge.to) out.push_back(edge), ++corners;
        }
        if (corners < 3) throw std::runtime_error("has fewer than 3 corners");
        if (out.size() > most_corners) throw std::runtime_error("has more than 1000 corners");
    }
    if (out.empty()) throw std::runtime_error("has no corners");
    return out;
}

double side(const Edge& edge, const Point& p) {
    return (edge.to[0] - edge.from[0]) * (p[1] - edge.from[1]) -
           (edge.to[1] - edge.from[1]) * (p[0] - edge.from[0]);
}

void refuse_crossings(const std::vector<Edge>& edges) {
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t k = i + 1; k < edges.size(); ++k) {
            const Edge &a = edges[i], &b = edges[k];
            if (side(a, b.from) * side(a, b.to) < 0 && side(b, a.from) * side(b, a.to) < 0)
                throw std::runtime_error("crosses itself");
        }
}

/// Between two neighbouring heights of corners: edges from left to right, of which each pair has the inside
/// between it.
struct Slab {
    double low, high;
    std::vector<const Edge*> edges;
    /// Whether x is inside at the height y, which is within the slab.
    bool holds(double x, double y) const {
        return std::ranges::count_if(edges, [&](const Edge* e) { return e->x_at(y) < x; }) % 2 == 1;
    }
};

std::vector<Slab> slabs_of(const std::vector<Edge>& edges) {
    std::vector<double> heights;
    for (const Edge& edge : edges) heights.push_back(edge.from[1]);
    std::ranges::sort(heights);
    heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    std::vector<Slab> out;
    for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
        Slab slab{heights[i], heights[i + 1], {}};
        for (const Edge& edge : edges)
            if (!edge.is_level() && edge.spans(slab.low, slab.high)) slab.edges.push_back(&edge);
        const double middle = (slab.low + slab.high) / 2;
        std::ranges::stable_sort(slab.edges, {}, [&](const Edge* e) { return e->x_at(middle); });
        out.push_back(std::move(slab));
    }
    return out;
}

class Body {
  public:
    explicit Body(double height) : height_(height) {}

    /// Seen from above counter-clockwise.
    void add_lids(const Point& a, const Point& b, const Point& c) {
        if (a == b || b == c || c == a) return;
        add(corner(a, height_), corner(b, height_), corner(c, height_));
        add(corner(a, 0), corner(c, 0), corner(b, 0));
    }
    /// The inside lies to the left of the way.
    void add_wall(const Point& from, const Point& to) {
        if (from == to) return;
        add(corner(from, 0), corner(to, 0), corner(to, height_));
        add(corner(from, 0), corner(to, height_), corner(from, height_));
    }
    ShapeSurface surface;

  private:
    std::uint32_t corner(const Point& p, double z) {
        const auto [known, is_new] = numbers_.try_emplace({p[0], p[1], z}, surface.positions.size());
        if (is_new) surface.positions.push_back({p[0], p[1], z});
        return known->second;
    }
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        surface.indices.insert(surface.indices.end(), {a, b, c});
    }
    double height_;
    std::map<std::array<double, 3>, std::uint32_t> numbers_;
};

}  // namespace

Shape drawn_up(const std::vector<Outline>& outlines, double height) {
    if (!(height > 0 && height <= scene_limits::extent))
        throw std::runtime_error("has no height above 0 and up to 100 km");
    const std::vector<Edge> edges = edges_of(outlines);
    refuse_crossings(edges);
    const std::vector<Slab> slabs = slabs_of(edges);
    Body body(height);
    const auto at = [](const Edge& edge, double y) {
        return edge.from[1] == y ? edge.from : edge.to[1] == y ? edge.to : Point{edge.x_at(y), y};
    };
    for (const Slab& slab : slabs)
        for (std::size_t i = 0; i + 1 < slab.edges.size(); i += 2) {
            const Edge &left = *slab.edges[i], &right = *slab.edges[i + 1];
            const Point a = at(left, slab.low), b = at(right, slab.low), c = at(right, slab.high),
                        d = at(left, slab.high);
            body.add_lids(a, b, c), body.add_lids(a, c, d);
            body.add_wall(b, c), body.add_wall(d, a);
        }
    for (const Edge& edge : edges) {
        if (!edge.is_level()) continue;
        const double y = edge.from[1], x = (edge.from[0] + edge.to[0]) / 2;
        bool above = false, below = false;
        for (const Slab& slab : slabs) {
            if (slab.low == y) above = slab.holds(x, y);
            if (slab.high == y) below = slab.holds(x, y);
        }
        const auto& [west, east] = std::minmax(edge.from, edge.to);
        if (above && !below) body.add_wall(west, east);
        if (below && !above) body.add_wall(east, west);
    }
    if (body.surface.indices.empty()) throw std::runtime_error("encloses nothing");
    return {std::move(body.surface)};
}

}  // namespace echoloop::worlds
