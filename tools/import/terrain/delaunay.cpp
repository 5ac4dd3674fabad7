#include "tools/import/terrain/delaunay.h"

namespace echoloop::worlds {

GridDelaunay::GridDelaunay(std::int32_t width, std::int32_t height)
    : points_{{0, 0}, {width - 1, 0}, {width - 1, height - 1}, {0, height - 1}},
      corners_{0, 1, 2, 0, 2, 3},
      twins_{none, none, 3, 2, none, none} {}

std::int64_t GridDelaunay::side(Edge e, GridPoint p) const {
    const GridPoint a = points_[corners_[e]], b = points_[corners_[next(e)]];
    return std::int64_t{b.x - a.x} * (p.y - a.y) - std::int64_t{b.y - a.y} * (p.x - a.x);
}

/// A walk towards the point, which ends in every Delaunay triangulation.
std::uint32_t GridDelaunay::find(GridPoint p, std::uint32_t near) const {
    for (std::uint32_t t = near;;) {
        Edge out = none;
        for (Edge e = 3 * t; e < 3 * t + 3 && out == none; ++e)
            if (side(e, p) < 0) out = e;
        if (out == none) return t;
        t = twins_[out] / 3;
    }
}

std::uint32_t GridDelaunay::add() {
    corners_.resize(corners_.size() + 3);
    twins_.resize(twins_.size() + 3, none);
    return size() - 1;
}

void GridDelaunay::link(Edge a, Edge b) {
    twins_[a] = b;
    if (b != none) twins_[b] = a;
}

void GridDelaunay::set(std::uint32_t t, std::uint32_t a, std::uint32_t b, Edge twin) {
    corners_[3 * t] = a;
    corners_[3 * t + 1] = b;
    corners_[3 * t + 2] = static_cast<std::uint32_t>(points_.size() - 1);
    link(3 * t, twin);
    changed_.push_back(t);
    doubtful_.push_back(t);
}

bool GridDelaunay::insert(GridPoint p, std::uint32_t near) {
    const std::uint32_t t = find(p, near);
    for (Edge e = 3 * t; e < 3 * t + 3; ++e)
        if (points_[corners_[e]] == p) return false;
    changed_.clear();
    points_.push_back(p);
    Edge on = none;
    for (Edge e = 3 * t; e < 3 * t + 3; ++e)
        if (side(e, p) == 0) on = e;
    on == none ? split_triangle(t) : split_edge(on);
    restore();
    return true;
}

void GridDelaunay::split_triangle(std::uint32_t t) {
    const auto [a, b, c] = triangle(t);
    const Edge ab = twins_[3 * t], bc = twins_[3 * t + 1], ca = twins_[3 * t + 2];
    const std::uint32_t u = add(), v = add();
    set(t, a, b, ab), set(u, b, c, bc), set(v, c, a, ca);
    link(3 * t + 1, 3 * u + 2), link(3 * u + 1, 3 * v + 2), link(3 * v + 1, 3 * t + 2);
}

void GridDelaunay::split_edge(Edge e) {
    const Edge f = twins_[e];
    const std::uint32_t a = corners_[e], b = corners_[next(e)], c = corners_[previous(e)];
    const Edge bc = twins_[next(e)], ca = twins_[previous(e)];
    const std::uint32_t t = e / 3, t2 = add();
    if (f == none) {
        set(t, c, a, ca), set(t2, b, c, bc);
        link(3 * t + 2, 3 * t2 + 1);
        twins_[3 * t + 1] = twins_[3 * t2 + 2] = none;
        return;
    }
    const std::uint32_t d = corners_[previous(f)], u = f / 3, u2 = add();
    const Edge ad = twins_[next(f)], db = twins_[previous(f)];
    set(t, c, a, ca), set(t2, b, c, bc), set(u, d, b, db), set(u2, a, d, ad);
    link(3 * t + 2, 3 * t2 + 1), link(3 * u + 2, 3 * u2 + 1);
    link(3 * u + 1, 3 * t2 + 2), link(3 * u2 + 2, 3 * t + 1);
}

/// Whether `p` is within the circle through the corners of the edge's triangle.
bool GridDelaunay::in_circle(Edge e, GridPoint p) const {
    std::array<std::int64_t, 3> x, y;
    const std::uint32_t t = e / 3;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const GridPoint q = points_[corners_[3 * t + k]];
        x[k] = q.x - p.x, y[k] = q.y - p.y;
    }
    const auto minor = [&](int i, int j) { return x[i] * y[j] - x[j] * y[i]; };
    const auto square = [&](int i) { return x[i] * x[i] + y[i] * y[i]; };
    return square(0) * minor(1, 2) - square(1) * minor(0, 2) + square(2) * minor(0, 1) > 0;
}

void GridDelaunay::restore() {
    while (!doubtful_.empty()) {
        const std::uint32_t t = doubtful_.back();
        doubtful_.pop_back();
        const Edge e = 3 * t, f = twins_[e];
        if (f == none || !in_circle(e, points_[corners_[previous(f)]])) continue;
        const std::uint32_t a = corners_[e], b = corners_[e + 1], d = corners_[previous(f)], u = f / 3;
        const Edge ad = twins_[next(f)], db = twins_[previous(f)], bp = twins_[e + 1];
        set(t, a, d, ad);
        changed_.pop_back();  // it is there already
        set(u, d, b, db);
        link(3 * u + 1, bp), link(3 * t + 1, 3 * u + 2);
    }
}

}  // namespace echoloop::worlds
