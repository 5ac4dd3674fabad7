#include "render/paths/corners.h"

#include <algorithm>
#include <numbers>

namespace echoloop {
namespace {

constexpr double right_angle_tolerance = 0.0175;  ///< rad, one degree
constexpr double weakest_corner = 1e-2;           ///< amplitude of all reflections together
constexpr std::size_t most_corners = 8;
constexpr int most_thirds = 32;  ///< rays in search of a third face

bool square(Vec3 a, Vec3 b) { return std::abs(dot(a, b)) < right_angle_tolerance; }

struct Plane {
    Vec3 normal;
    double offset;
};

Vec3 common_point(const Plane& a, const Plane& b, const Plane& c) {
    const Vec3 bc = cross(b.normal, c.normal);
    const Vec3 sum =
        a.offset * bc + b.offset * cross(c.normal, a.normal) + c.offset * cross(a.normal, b.normal);
    return 1 / dot(a.normal, bc) * sum;
}

Plane plane_of(const Encounter& met) { return {met.normal, dot(met.normal, met.point)}; }

}  // namespace

double mirror_zone_radius(double wavenumber, double range) {
    return std::sqrt(range / wavenumber);  // pi r^2 = lambda R / 2 with lambda = 2 pi / k
}

void CornerList::note(const Encounter& first, const Encounter& second, Vec3 onward) {
    if (!square(first.normal, second.normal) ||
        std::abs(first.reflection * second.reflection) < weakest_corner)
        return;
    const Plane a = plane_of(first), b = plane_of(second);
    const Vec3 edge = cross(a.normal, b.normal);
    add({common_point(a, b, {edge, dot(edge, ping_.sonar)}), 2});
    if (++thirds_ > most_thirds) return;
    const Vec3 back = onward - 2 * dot(onward, second.normal) * second.normal;
    const auto third = ping_.space.meet(second.point, back, 2 * ping_.end_range);
    if (third && square(third->normal, a.normal) && square(third->normal, b.normal))
        add({common_point(a, b, plane_of(*third)), 3});
}

void CornerList::add(const Corner& corner) {
    const double range = norm(corner.point - ping_.sonar);
    if (range >= ping_.end_range || corners_.size() >= most_corners) return;
    const double near = mirror_zone_radius(ping_.wavenumber, range) / 2;
    const bool known = std::ranges::any_of(corners_, [&](const Corner& other) {
        return other.faces == corner.faces && norm(other.point - corner.point) < near;
    });
    if (!known) corners_.push_back(corner);
}

}  // namespace echoloop
