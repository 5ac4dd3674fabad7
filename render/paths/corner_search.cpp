#include <numbers>

#include "render/paths/searches.h"

namespace echoloop {
namespace {

constexpr int zone_rays = 32;
constexpr double weakest_ways = 1e-2;  ///< amplitude of both ways: what is weaker is not looked into

/// The product of the reflections of a ray that comes back to the sonar after `faces` of them, else 0.
double returned(const PathPing& ping, Vec3 direction, int faces) {
    constexpr double retro =
        0.998;  // cosine: twice the one degree by which a corner may be out of square, and more
    Vec3 at = ping.sonar, heading = direction;
    double reflection = 1;
    for (int face = 0; face < faces; ++face) {
        const auto met = ping.space.meet(at, heading, 2 * ping.end_range);
        if (!met) return 0;
        reflection *= met->reflection;
        heading = heading - 2 * dot(heading, met->normal) * met->normal;
        at = met->point;
    }
    if (dot(heading, direction) > -retro || ping.space.blocked(at, ping.sonar)) return 0;
    return reflection;
}

/// Mean of returned() over the zone about the corner, by points on a sunflower's spiral.
double zone_reflection(const PathPing& ping, const Corner& corner, Vec3 axis, double range) {
    const Vec3 side = std::abs(axis.z) < 0.9 ? cross(axis, {0, 0, 1}) : cross(axis, {1, 0, 0});
    const Vec3 u = 1 / norm(side) * side, v = cross(axis, u);
    const double radius = mirror_zone_radius(ping.wavenumber, range);
    double sum = 0;
    for (int i = 0; i < zone_rays; ++i) {
        const double r = radius * std::sqrt((i + 0.5) / zone_rays), angle = i * 2.39996322972865332;
        const Vec3 aim = corner.point + r * std::cos(angle) * u + r * std::sin(angle) * v - ping.sonar;
        sum += returned(ping, 1 / norm(aim) * aim, corner.faces);
    }
    return sum / zone_rays;
}

}  // namespace

void find_corner_echoes(const PathPing& ping, std::span<const Corner> corners, std::vector<TargetEcho>& out) {
    for (const Corner& corner : corners) {
        const double range = norm(corner.point - ping.sonar);
        if (range < 1e-2) continue;
        const Vec3 axis = 1 / range * (corner.point - ping.sonar);
        const auto sight = ping.sight(corner.point);
        if (!sight) continue;
        const FanDirection seen = ping.received(ping.seen(sight->direction), sight->length);
        if (std::abs(seen.transmit * seen.receive) < weakest_ways) continue;
        const double reflection = zone_reflection(ping, corner, axis, range);
        // A mirror at the range R is heard like the image of the sonar at 2R, so as a scatterer of (R / 2)^2.
        const double amplitude =
            ping.arrival(range, range) * range / 2 * seen.transmit * seen.receive * reflection;
        if (amplitude == 0) continue;
        const double phase = 2 * ping.wavenumber * sight->length + (amplitude < 0 ? std::numbers::pi : 0);
        out.push_back({sight->length, amplitude * amplitude, std::remainder(phase, 2 * std::numbers::pi),
                       seen.bearing, corner.faces, seen.elevation, seen.turned});
    }
}

}  // namespace echoloop
