#include "render/paths/path_ping.h"

#include <algorithm>
#include <cmath>

namespace echoloop {
namespace {

constexpr double weakest_mirror = 1e-3;  ///< amplitude of a reflection: 60 dB below a perfect one

/// A mirror that is taken for a plane.
struct MirrorPlane {
    Vec3 on, normal;
};

/// The way to `point` by a mirror: to where the sight line to its image crosses the mirror, and on.
struct MirrorWay {
    Vec3 direction, at;
    double length;
    MirrorPlane plane;
};

std::optional<MirrorWay> by_mirror(Vec3 sonar, Vec3 point, const MirrorPlane& plane) {
    const double before = dot(sonar - plane.on, plane.normal), behind = dot(point - plane.on, plane.normal);
    if (!(before > 0 && behind > 0)) return std::nullopt;
    const Vec3 to_image = mirrored(point, plane.on, plane.normal) - sonar;
    const double length = norm(to_image), to_mirror = length * before / (before + behind);
    const Vec3 direction = 1 / length * to_image;
    return MirrorWay{direction, sonar + to_mirror * direction, length, plane};
}

/// Empty where bent rays do not reach the image.
std::optional<Way> way_by(const PathPing& ping, const MirrorWay& found, Vec3 point, double reflection) {
    const auto sight = ping.sight_by(point, found.plane.on, found.plane.normal, found.at);
    if (!sight) return std::nullopt;
    return Way{ping.seen(sight->direction), sight->length, reflection, 1, 1};
}

/// Aims at the image in the plane of the triangle that was met last, until the ray meets it where it should.
std::optional<MirrorWay> settle(const PathPing& ping, Vec3 point, MirrorPlane plane, double& reflection) {
    for (int round = 0; round < 4; ++round) {
        const auto way = by_mirror(ping.sonar, point, plane);
        if (!way) return std::nullopt;
        const auto met = ping.space.meet(ping.sonar, way->direction, way->length);
        if (!met || met->mu == 0 || std::abs(met->reflection) < weakest_mirror) return std::nullopt;
        if (dot(met->normal, plane.normal) > 1 - 1e-6 &&
            norm(met->point - way->at) < 1e-3 * (1 + way->length)) {
            if (ping.space.blocked(way->at, point)) return std::nullopt;
            reflection = met->reflection;
            return way;
        }
        plane = {met->point, met->normal};
    }
    return std::nullopt;
}

double level(Vec3 line) { return std::sqrt(line.x * line.x + line.y * line.y); }

/// Where a ray leaves that ends at `line` from the sonar.
std::optional<Sight> along(const BentRay& ray, Vec3 line) {
    if (ray.clearance < 0) return std::nullopt;
    const double across = level(line), length = norm(line), sine = std::sin(ray.turn),
                 cosine = std::cos(ray.turn);
    const Vec3 ahead = across > 0 ? 1 / across * Vec3{line.x, line.y, 0} : Vec3{1, 0, 0};
    return Sight{
        1 / length *
            ((across * cosine - line.z * sine) * ahead + (line.z * cosine + across * sine) * Vec3{0, 0, 1}),
        length * (1 + ray.stretch)};
}

}  // namespace

std::optional<Sight> PathPing::sight(Vec3 point) const {
    const Vec3 line = point - sonar;
    const double length = norm(line);
    if (rays == nullptr) return Sight{1 / length * line, length};
    return along(rays->at(level(line), -line.z), line);
}

std::optional<Sight> PathPing::sight_by(Vec3 point, Vec3 on, Vec3 normal, Vec3 at) const {
    constexpr double a_degree = 0.0175, almost_level = 0.999999;
    const Vec3 image = mirrored(point, on, normal), line = image - sonar;
    const double length = norm(line);
    if (rays == nullptr) return Sight{1 / length * line, length};
    if (std::abs(normal.z) < a_degree) return sight(image);
    if (images != nullptr && normal.z < -almost_level)
        if (const auto surface = space.surface_above(sonar);
            surface && std::abs(on.z - surface->height) < 1e-6)
            return along(images->to(level(line), line.z), line);
    return Sight{1 / length * line, leg(sonar, at) + leg(at, point)};
}

double PathPing::lift(Vec3 direction, double length, bool by_surface) const {
    if (rays == nullptr || (by_surface && images == nullptr)) return 0;
    return by_surface ? images->lift(direction.z, length) : lift_to(*rays, direction.z, length);
}

/// A bent ray is taken for the cubic that leaves and arrives as it does, in pieces that stray from it by a
/// centimetre at most, or in eight.
bool PathPing::hidden(Vec3 point) const {
    if (rays == nullptr) return space.blocked(sonar, point);
    constexpr double stray = 0.01;  // m
    const Vec3 line = point - sonar;
    const double length = norm(line), across = std::hypot(line.x, line.y);
    const BentRay ray = rays->at(across, -line.z);
    const Vec3 ahead = across > 0 ? 1 / across * Vec3{line.x, line.y, 0} : Vec3{};
    const Vec3 upwards = 1 / length * (across * Vec3{0, 0, 1} - line.z * ahead);
    const double sag = length / 8 * (std::abs(std::tan(ray.turn)) + std::abs(std::tan(ray.turn + ray.bow)));
    const int pieces = static_cast<int>(std::ceil(std::clamp(std::sqrt(sag / stray), 1.0, 8.0)));
    Vec3 from = sonar;
    for (int piece = 1; piece <= pieces; ++piece) {
        const double s = static_cast<double>(piece) / pieces;
        const double up =
            length * s * (1 - s) * ((1 - s) * std::tan(ray.turn) - s * std::tan(ray.turn + ray.bow));
        const Vec3 to = piece < pieces ? sonar + s * line + up * upwards : point;
        if (space.blocked(from, to)) return true;
        from = to - 1e-3 * (to - from);  // pieces overlap, since nothing is seen right at their ends
    }
    return false;
}

std::optional<Way> direct_way(const PathPing& ping, Vec3 point) {
    if (norm(point - ping.sonar) < 1e-3) return std::nullopt;
    const auto sight = ping.sight(point);
    if (!sight || ping.hidden(point)) return std::nullopt;
    return Way{ping.seen(sight->direction), sight->length, 1, 1, 0};
}

std::optional<Way> surface_way(const PathPing& ping, Vec3 point) {
    const auto surface = ping.space.surface_above(ping.sonar);
    if (!surface) return std::nullopt;
    const auto way = by_mirror(ping.sonar, point, {{0, 0, surface->height}, {0, 0, -1}});
    if (!way) return std::nullopt;
    const double reflection = ping.space.surface_reflection(way->direction.z);
    if (std::abs(reflection) < weakest_mirror) return std::nullopt;
    if (ping.space.blocked(ping.sonar, way->at) || ping.space.blocked(way->at, point)) return std::nullopt;
    return way_by(ping, *way, point, reflection);
}

std::vector<Way> scene_ways(const PathPing& ping, Vec3 point) {
    std::vector<Way> ways;
    std::vector<Vec3> known;
    const Vec3 middle = 0.5 * (ping.sonar + point);
    for (const Vec3 seed : {Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}}) {
        const auto met = ping.space.meet(middle, seed, ping.end_range);
        if (!met) continue;
        double reflection = 0;
        const auto way = settle(ping, point, {met->point, met->normal}, reflection);
        if (!way) continue;
        bool is_new = true;
        for (const Vec3 other : known) is_new = is_new && norm(other - way->at) > 1e-2 * (1 + way->length);
        if (!is_new) continue;
        known.push_back(way->at);
        if (const auto made = way_by(ping, *way, point, reflection)) ways.push_back(*made);
    }
    return ways;
}

}  // namespace echoloop
