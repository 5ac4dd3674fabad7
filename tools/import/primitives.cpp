#include "tools/import/primitives.h"

#include <cmath>
#include <numbers>

namespace echoloop::worlds {
namespace {

constexpr std::uint32_t around = 48;  ///< 7.5 deg a facet: the renderer takes them for a curved surface

/// Radius and height of a ring of corners.
struct Ring {
    double radius, z;
};

/// A body of revolution about z from the lowest ring to the highest; a ring of radius 0 is a tip.
ShapeSurface turned(const std::vector<Ring>& rings) {
    ShapeSurface out;
    for (const Ring& ring : rings)
        for (std::uint32_t i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around;
            out.positions.push_back({ring.radius * std::cos(angle), ring.radius * std::sin(angle), ring.z});
        }
    for (std::uint32_t r = 0; r + 1 < rings.size(); ++r)
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t a = r * around + i, b = r * around + (i + 1) % around, c = a + around,
                                d = b + around;
            if (rings[r].radius > 0) out.indices.insert(out.indices.end(), {a, b, d});
            if (rings[r + 1].radius > 0) out.indices.insert(out.indices.end(), {a, d, c});
        }
    return out;
}

/// Rings of a quarter of a circle from `from` to `to` (rad above the equator), about the height z.
void add_arc(std::vector<Ring>& rings, double radius, double z, double from, double to) {
    constexpr int steps = 12;
    for (int i = 0; i <= steps; ++i) {
        const double angle = from + (to - from) * i / steps;
        const bool tip = std::abs(std::abs(angle) - std::numbers::pi / 2) < 1e-9;
        rings.push_back({tip ? 0 : radius * std::cos(angle), z + radius * std::sin(angle)});
    }
}

}  // namespace

Shape box(Vec3 size) {
    ShapeSurface out;
    for (int i = 0; i < 8; ++i)
        out.positions.push_back(
            {(i & 1 ? 0.5 : -0.5) * size.x, (i & 2 ? 0.5 : -0.5) * size.y, (i & 4 ? 0.5 : -0.5) * size.z});
    out.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                   2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    return {out};
}

Shape cylinder(double radius, double length) {
    return {turned({{0, -length / 2}, {radius, -length / 2}, {radius, length / 2}, {0, length / 2}})};
}

Shape cone(double radius, double length) {
    return {turned({{0, -length / 2}, {radius, -length / 2}, {0, length / 2}})};
}

Shape ellipsoid(Vec3 radii) {
    std::vector<Ring> rings;
    add_arc(rings, 1, 0, -std::numbers::pi / 2, 0);
    rings.pop_back();
    add_arc(rings, 1, 0, 0, std::numbers::pi / 2);
    ShapeSurface out = turned(rings);
    for (Vec3& p : out.positions) p = {p.x * radii.x, p.y * radii.y, p.z * radii.z};
    return {out};
}

Shape capsule(double radius, double length) {
    std::vector<Ring> rings;
    add_arc(rings, radius, -length / 2, -std::numbers::pi / 2, 0);
    add_arc(rings, radius, length / 2, 0, std::numbers::pi / 2);
    return {turned(rings)};
}

Shape plane(Vec3 normal, double length, double width) {
    // The turn from z to the normal the shortest way; an upside-down plane is turned about x.
    const double size = norm(normal);
    const Vec3 n = size > 0 ? (1 / size) * normal : Vec3{0, 0, 1};
    const Vec3 axis = cross({0, 0, 1}, n);
    const double sine = norm(axis);
    const Quat turn = axis_angle(sine > 1e-9 ? (1 / sine) * axis : Vec3{1, 0, 0}, std::atan2(sine, n.z));
    ShapeSurface out;
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        out.positions.push_back(rotate(turn, {x * length / 2, y * width / 2, 0}));
    out.indices = {0, 1, 2, 0, 2, 3};
    return {out};
}

}  // namespace echoloop::worlds
