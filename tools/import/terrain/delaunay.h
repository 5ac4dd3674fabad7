// The Delaunay triangulation of points of a grid, which grows by one point at a time. Exact: coordinates are
// whole numbers. Bowyer's and Watson's insertion by flips: Guibas and Stolfi, ACM TOG 4 (1985), 74-123.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/import/terrain/heights.h"

namespace echoloop::worlds {

class GridDelaunay {
  public:
    /// Of a side: the test of a circle is a whole number of 64 bits.
    static constexpr std::int32_t most_samples = 28'000;

    /// Two triangles over the rectangle. Both sides have 2 samples to `most_samples`.
    GridDelaunay(std::int32_t width, std::int32_t height);

    /// `p` is within the rectangle; `near` is a triangle to look for it from. False: it is a vertex already.
    bool insert(GridPoint p, std::uint32_t near);
    /// The triangles around the point that was inserted last; all others are as they were.
    std::span<const std::uint32_t> changed() const { return changed_; }

    std::uint32_t size() const { return static_cast<std::uint32_t>(corners_.size() / 3); }
    std::span<const GridPoint> points() const { return points_; }
    /// Numbers of its points, counter-clockwise with x to the right and y upwards.
    std::array<std::uint32_t, 3> triangle(std::uint32_t t) const {
        return {corners_[3 * t], corners_[3 * t + 1], corners_[3 * t + 2]};
    }

  private:
    using Edge = std::uint32_t;  ///< 3 t + k goes from corner k of triangle t to the next corner
    static constexpr Edge none = ~Edge{0};

    static Edge next(Edge e) { return e % 3 == 2 ? e - 2 : e + 1; }
    static Edge previous(Edge e) { return e % 3 == 0 ? e + 2 : e - 1; }
    /// Twice the area of the triangle from the edge to `p`; positive to the left of the edge.
    std::int64_t side(Edge e, GridPoint p) const;
    std::uint32_t find(GridPoint p, std::uint32_t near) const;
    /// Triangle `t` becomes the one from the outer edge `a` to `b`, whose other side is `twin`, to the new
    /// point.
    void set(std::uint32_t t, std::uint32_t a, std::uint32_t b, Edge twin);
    std::uint32_t add();
    void link(Edge a, Edge b);
    void split_triangle(std::uint32_t t);
    void split_edge(Edge e);
    void restore();
    bool in_circle(Edge e, GridPoint p) const;

    std::vector<GridPoint> points_;
    std::vector<std::uint32_t> corners_;
    std::vector<Edge> twins_;
    std::vector<std::uint32_t> changed_;
    std::vector<std::uint32_t> doubtful_;  ///< triangles whose outer edge may have to be flipped
};

}  // namespace echoloop::worlds
