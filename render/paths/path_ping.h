// One ping for those who look for its paths: where the sonar is, what it makes of directions and of path
// lengths. Finds no path itself.
#pragma once

#include <cmath>
#include <numbers>

#include "render/eigenrays.h"
#include "render/image_rays.h"
#include "render/paths/fan_pattern.h"
#include "render/paths/lobe_cells.h"
#include "render/paths/path_space.h"
#include "render/ray_table.h"

namespace echoloop {

/// A way from the sonar to a scatterer.
struct Way {
    FanDirection at_sonar;
    double length = 0;      ///< m
    double reflection = 1;  ///< product of the amplitudes of its reflections
    double cosine = 1;      ///< of incidence at the scatterer, where that is a surface
    int bounces = 0;
};

/// Where a point is seen from the sonar.
struct Sight {
    Vec3 direction;     ///< unit, in which the ray leaves and comes back
    double length = 0;  ///< m, of c t where rays bend
};

/// An echo of a scatterer of unit cross-section by one way there and one way back.
struct PairEcho {
    double range = 0;      ///< m, apparent: half the length of both ways
    double amplitude = 0;  ///< uPa; negative: turned by pi
    double bearing = 0;    ///< rad, of arrival, relative to Shot::pan
    double elevation = 0;  ///< rad, the same over the fan's plane
    double turned = 0;     ///< as TargetEcho's
};

struct PathPing {
    const Shot& shot;
    const PathSpace& space;
    const FanPattern& pattern;
    Vec3 sonar;
    Quat world_from_fan;
    double absorption = 0;  ///< Np/m
    double wavenumber = 0;  ///< rad/m
    double end_range = 0;   ///< m
    bool spreading = true;
    double source = 0;               ///< uPa at 1 m
    double resolution = 0;           ///< m of range, that of the pulse
    double least = 0;                ///< uPa, of an echo of one point that may be heard
    Vec3 turning{};                  ///< rad per m of range, about the fan's axes, until an echo is back
    const RayTable* rays = nullptr;  ///< null: they are straight
    /// Null: those that the water's surface reflects are straight, and take their time.
    const ImageRays* images = nullptr;
    const Eigenrays* eigenrays = nullptr;  ///< null: nobody asks for more than the first

    FanDirection seen(Vec3 world_direction) const {
        return pattern.at(rotate(conjugate(world_from_fan), world_direction));
    }

    /// The same without its angles.
    FanWeights heard(Vec3 world_direction) const {
        return pattern.weights(rotate(conjugate(world_from_fan), world_direction));
    }

    /// The straight way or the first of the bent ones, whatever is between; empty in a shadow.
    std::optional<Sight> sight(Vec3 point) const;
    /// The same by way of a mirror through `on`, which the ray meets at `at` if it is straight. Bent rays are
    /// those to the image in the water's surface or in an upright mirror; by others the legs stay straight.
    std::optional<Sight> sight_by(Vec3 point, Vec3 on, Vec3 normal, Vec3 at) const;
    /// rad, by how much the straight line to where a ray is after `length` m of c t lies higher than the
    /// ray's `direction` at the sonar; where it has been at the surface, that to its image.
    double lift(Vec3 direction, double length, bool by_surface) const;
    /// Whether something is between the sonar and the point, along that way.
    bool hidden(Vec3 point) const;

    /// m, the length of a leg between two points, of c t where rays bend: the leg itself stays straight.
    double leg(Vec3 from, Vec3 to) const {
        return norm(to - from) * (rays != nullptr ? rays->slowness(sonar.z - from.z, sonar.z - to.z) : 1);
    }

    /// How an echo that arrives from there is heard, when it has come `range` m: its reception, bearing and
    /// elevation are those of where the sonar looks by then.
    FanDirection received(const FanDirection& from, double range) const {
        if (turning == Vec3{}) return from;
        const Vec3 direction = fan_direction(from.bearing, from.elevation);
        const Vec3 seen_then = direction - range * cross(turning, direction);
        FanDirection out = pattern.at(1 / norm(seen_then) * seen_then);
        out.transmit = from.transmit;
        out.turned = std::remainder(out.bearing - from.bearing, 2 * std::numbers::pi);
        return out;
    }

    /// uPa for amplitude 1 of the patterns, by ways of the lengths `there` and `back`.
    double arrival(double there, double back) const {
        const double range = (there + back) / 2;
        const double spread = (spreading ? 1 : range * range) / (there * back);
        return source * spread * std::exp(-absorption * (there + back));
    }

    /// Calls `add` with the echo there and back by one way.
    template <typename Add>
    void echo(const Way& way, Add&& add) const {
        if (way.length >= end_range) return;
        const FanDirection back = received(way.at_sonar, way.length);
        const double patterns = back.transmit * back.receive;
        add(PairEcho{way.length, arrival(way.length, way.length) * patterns * way.reflection * way.reflection,
                     back.bearing, back.elevation, back.turned});
    }

    /// The same for two different ways: out by one and back by the other, and the reverse. Both take as long
    /// and are in phase, so one beam hears the sum of their amplitudes; beams of a fan that look to different
    /// sides hear one each.
    template <typename Add>
    void echo(const Way& a, const Way& b, Add&& add) const {
        const double range = (a.length + b.length) / 2;
        if (range >= end_range) return;
        const double base = arrival(a.length, b.length) * a.reflection * b.reflection;
        const FanDirection back_a = received(a.at_sonar, range), back_b = received(b.at_sonar, range);
        const double by_a = base * back_b.transmit * back_a.receive;
        const double by_b = base * back_a.transmit * back_b.receive;
        const double apart = std::abs(back_a.bearing - back_b.bearing);
        const bool in_one_row =
            shot.rows() == 1 || std::abs(back_a.elevation - back_b.elevation) < shot.fan_height / 2;
        if (shot.bearings.size() == 1 || (apart < shot.beam_width / 2 && in_one_row)) {
            const FanDirection& from = std::abs(by_a) > std::abs(by_b) ? back_a : back_b;
            add(PairEcho{range, by_a + by_b, from.bearing, from.elevation, from.turned});
        } else {
            add(PairEcho{range, by_a, back_a.bearing, back_a.elevation, back_a.turned});
            add(PairEcho{range, by_b, back_b.bearing, back_b.elevation, back_b.turned});
        }
    }
};

/// The way straight to `point`, or empty where something is between.
std::optional<Way> direct_way(const PathPing& ping, Vec3 point);

/// All of them that are free, where rays bend and PathPing::eigenrays has more than the first; with the focus
/// of their rays among what they reflect.
std::vector<Way> direct_ways(const PathPing& ping, Vec3 point);

/// The way by the water's surface, or empty.
std::optional<Way> surface_way(const PathPing& ping, Vec3 point);

/// Ways by one reflection at triangles: below, and on the four sides, of the middle between sonar and point.
std::vector<Way> scene_ways(const PathPing& ping, Vec3 point);

}  // namespace echoloop
