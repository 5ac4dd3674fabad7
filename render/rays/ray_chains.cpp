#include "render/rays/ray_chains.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "render/rays/chain_shooter.h"

namespace echoloop::rays {
namespace {

/// m, by which a chord may stray from its ray there.
double allowed_at(const ChainPoint& point, const ChordTolerance& tolerance) {
    return std::max(tolerance.distance, tolerance.angle * point.length);
}

/// The point `above` m over it, across the ray.
ChainPoint beside(ChainPoint point, double above) {
    point.x -= above * std::sin(point.elevation), point.z += above * std::cos(point.elevation);
    return point;
}

/// Whether a chord from `a` to `b`, beside the first and the last point of a ray, may stand for it.
bool chord_fits(std::span<const ChainPoint> points, const ChainPoint& a, const ChainPoint& b,
                const ChordTolerance& tolerance) {
    const double x = b.x - a.x, z = b.z - a.z, length = std::hypot(x, z);
    double along = 0;
    for (const ChainPoint& p : points.subspan(1)) {
        const double stray = ((p.z - a.z) * x - (p.x - a.x) * z) / length,
                     gone = (p.x - a.x) * x + (p.z - a.z) * z;
        if (std::abs(stray) > allowed_at(p, tolerance) || !(gone > along)) return false;
        along = gone;
    }
    return true;
}

/// Whether the ray between its first and its last point may be taken for an even arc.
bool arc_fits(std::span<const ChainPoint> points, const ChordTolerance& tolerance) {
    constexpr double most_angle = 5e-4, most_time = 2e-4;  // rad, of the direction; share
    constexpr std::size_t looks = 12;
    const ChainPoint &a = points.front(), &b = points.back();
    const double x = b.x - a.x, z = b.z - a.z, square = x * x + z * z, turn = b.elevation - a.elevation;
    // How rays beside it differ is even over short arcs only.
    if (std::sqrt(square) * std::abs(turn) / 8 > (allowed_at(a, tolerance) + allowed_at(b, tolerance)) / 2)
        return false;
    const std::size_t step = std::max<std::size_t>(1, points.size() / looks);
    for (std::size_t i = 1; i + 1 < points.size(); i += step) {
        const ChainPoint& p = points[i];
        const double share = ((p.x - a.x) * x + (p.z - a.z) * z) / square;
        const double stray = ((p.z - a.z) * x - (p.x - a.x) * z) / std::sqrt(square),
                     arc = -std::sqrt(square) * turn / 2 * share * (1 - share);
        if (std::abs(stray - arc) > allowed_at(p, tolerance) / 8) return false;
        if (std::abs(p.elevation - a.elevation - share * turn) > most_angle) return false;
        const double uneven = (b.speed - a.speed) / (a.speed + b.speed) * (1 - share);
        const double length = a.length + (b.length - a.length) * share * (1 + uneven);
        if (std::abs(p.length - length) > most_time * p.length) return false;
    }
    return true;
}

/// Within what makes sense beside a caustic, where rays to the first order say too much.
double slope_of(double slope, double straight) { return std::clamp(slope, -10 * straight, 10 * straight); }

/// A place of a ray, and its slopes for those that leave a little higher: as RayChains::Chord and Arc have
/// them.
struct ChainPlace {
    double length, length_slope, x, x_slope, z, z_slope, bow, bow_slope, width, beside, speed;
};

/// `reach`: rad, of rays that take the place's slopes. They hold at the same depth, since there a ray bends
/// by Snell's law and not by where it has got to; where it hardly sinks or rises, at the same length.
ChainPlace place_of(const ChainPoint& point, const ChainPoint& launch, double reach) {
    const double width = slope_of(point.width, point.length), speed = point.speed / launch.speed,
                 sine = std::sin(point.elevation), cosine = std::cos(point.elevation);
    double later = std::abs(sine) > 0.01 ? -width * cosine / (speed * sine) : 0;
    if (std::abs(later) * reach > 0.1 * point.length) later = 0;
    const double bow_slope =
        (later == 0 ? slope_of(point.speed * point.spread, 1) : speed * std::sin(launch.elevation) / sine) -
        1;
    const double level = point.length * std::cos(launch.elevation);
    return {point.length,
            later,
            point.x,
            speed * later * cosine - width * sine,
            point.z,
            later == 0 ? width * cosine : 0,
            point.elevation - launch.elevation,
            bow_slope,
            width,
            level > 1e-6 * point.length && level > 0 ? point.x / level : 1,
            speed};
}

std::array<float, 4> four(double a, double b, double c, double d) {
    return {static_cast<float>(a), static_cast<float>(b), static_cast<float>(c), static_cast<float>(d)};
}

/// Where a place is beside a chord: its share of it, and m above it.
struct Foot {
    double share, above;
};
Foot foot_of(const ChainPlace& place, const ChainPlace& begin, const ChainPlace& end, double rise) {
    const auto x = [&](const ChainPlace& p) { return p.x + rise * p.x_slope; };
    const auto z = [&](const ChainPlace& p) { return p.z + rise * p.z_slope; };
    const double dx = x(end) - x(begin), dz = z(end) - z(begin), px = x(place) - x(begin),
                 pz = z(place) - z(begin), square = dx * dx + dz * dz;
    return {(px * dx + pz * dz) / square, (pz * dx - px * dz) / std::sqrt(square)};
}
/// The same per rad.
Foot slope_of_foot(const ChainPlace& place, const ChainPlace& begin, const ChainPlace& end) {
    constexpr double step = 1e-5;
    const Foot low = foot_of(place, begin, end, -step), high = foot_of(place, begin, end, step);
    return {(high.share - low.share) / (2 * step), (high.above - low.above) / (2 * step)};
}

/// Whether arcs may share a chord: how the shares of a ray that leaves `reach` rad higher differ is known to
/// the first order.
bool parts_hold(std::span<const ChainPlace> places, double reach) {
    constexpr double most_shift = 0.002;
    for (const ChainPlace& place : places.subspan(1, places.size() - 2))
        if (!(std::abs(slope_of_foot(place, places.front(), places.back()).share) * reach < most_shift))
            return false;
    return true;
}

RayChains::Chord chord_between(const ChainPlace& a, const ChainPlace& b, bool last, std::size_t arc) {
    constexpr float none = std::numeric_limits<float>::infinity();
    return {four(a.x, a.z, b.x - a.x, b.z - a.z),
            four(a.x_slope, a.z_slope, b.x_slope - a.x_slope, b.z_slope - a.z_slope),
            static_cast<float>(a.length),
            static_cast<float>(1 / std::max(b.length - a.length, 1e-9)),
            last ? none : static_cast<float>(b.length),
            static_cast<std::int32_t>(arc),
            none,
            0};
}

/// Beside the chord from `begin` to `end`, over its `first` or `last` part.
RayChains::Arc arc_between(const ChainPlace& a, const ChainPlace& b, const ChainPlace& begin,
                           const ChainPlace& end, bool first, bool last) {
    Foot from = foot_of(a, begin, end, 0), to = foot_of(b, begin, end, 0),
         from_slope = slope_of_foot(a, begin, end), to_slope = slope_of_foot(b, begin, end);
    if (first) from.share = 0, from_slope.share = 0;
    if (last) to.share = 1, to_slope.share = 0;
    const double share = to.share - from.share;
    return {four(a.bow, b.bow - a.bow, a.length, b.length - a.length),
            four(a.bow_slope, b.bow_slope - a.bow_slope, a.length_slope, b.length_slope - a.length_slope),
            four(a.width, a.beside, a.speed, (b.speed - a.speed) / (a.speed + b.speed)),
            four(b.width - a.width, b.beside - a.beside, b.speed - a.speed, 0),
            four(from.share, 1 / share, from.above, to.above - from.above),
            four(from_slope.share, (from_slope.share - to_slope.share) / (share * share), from_slope.above,
                 to_slope.above - from_slope.above)};
}

/// Appends a ray's chords, as few as may be, and their arcs. Where chords meet they lie outside of the
/// ray's bend, so that they may lie inside for longer.
void add_chords(std::span<const ChainPoint> points, const ChordTolerance& tolerance, double reach,
                std::vector<RayChains::Chord>& chords, std::vector<RayChains::Arc>& arcs) {
    constexpr double outside = 0.5;  // of what is allowed
    const auto place = [&](const ChainPoint& point) { return place_of(point, points.front(), reach); };
    std::vector<ChainPlace> places;
    ChainPoint from = points.front();
    for (std::size_t begin = 0; begin + 1 < points.size();) {
        const auto end_of = [&](std::size_t i) {
            const double turn = points[i].elevation - points[begin].elevation;
            const double above = turn < 0 ? outside : turn > 0 ? -outside : 0;
            return beside(points[i], above * allowed_at(points[i], tolerance));
        };
        std::size_t end = begin + 1;
        ChainPoint to = points[end];
        while (end + 1 < points.size()) {
            const ChainPoint next = end_of(end + 1);
            if (!chord_fits(points.subspan(begin, end + 2 - begin), from, next, tolerance)) break;
            to = next, ++end;
        }
        places.assign(1, place(points[begin]));
        std::size_t arc = begin, first_end = end;
        for (std::size_t i = begin + 2; i <= end; ++i) {
            if (arc_fits(points.subspan(arc, i - arc + 1), tolerance)) continue;
            arc = i - 1;
            if (places.size() == 1) first_end = arc;
            places.push_back(place(points[arc]));
        }
        places.push_back(place(points[end]));
        if (!parts_hold(places, reach)) end = first_end, to = points[end], places.resize(2);
        const ChainPlace a = place(from), b = place(to);
        chords.push_back(chord_between(a, b, end + 1 == points.size(), arcs.size()));
        for (std::size_t i = 0; i + 1 < places.size(); ++i)
            arcs.push_back(arc_between(places[i], places[i + 1], a, b, i == 0, i + 2 == places.size()));
        if (places.size() > 2) {
            const RayChains::Arc& second = arcs[arcs.size() - places.size() + 2];
            chords.back().second_arc = second.part[0], chords.back().second_arc_slope = second.part_slope[0];
        }
        begin = end, from = to;
    }
}

}  // namespace

double RayChains::elevation(int row) {
    const double root = static_cast<double>(row - half) / half;
    return 2 * std::atan(root * std::abs(root));
}

RayChains::RayChains(const RayTable& table, ChordTolerance tolerance) {
    constexpr double points_per_chord = 4, margin = 1e-4;
    ChainShooter shooter(table, tolerance.distance / (points_per_chord * points_per_chord));
    std::vector<ChainPoint> points;
    for (int row = 0; row < rows; ++row) {
        const double low = elevation(std::max(row - 1, 0)), high = elevation(std::min(row + 1, rows - 1)),
                     reach = (high - low) / 4;
        shooter.shoot(elevation(row), reach, points);
        const ChainPoint &a = points.front(), &b = points.back();
        if (std::abs(b.elevation - a.elevation) > 1e-6 || std::abs(b.speed - a.speed) > 1e-3 ||
            !chord_fits(points, a, b, tolerance)) {
            lowest_bent_ = std::min(lowest_bent_, static_cast<float>(std::sin(low) - margin));
            highest_bent_ = std::max(highest_bent_, static_cast<float>(std::sin(high) + margin));
        }
        const std::size_t first = chords_.size();
        add_chords(points, tolerance, reach, chords_, arcs_);
        rows_.push_back({static_cast<std::int32_t>(first), chords_[first].inverse_length});
    }
    arcs_.emplace_back();
}

}  // namespace echoloop::rays
