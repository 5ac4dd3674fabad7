#include "render/refraction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace echoloop {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Water between two depths, in which sound speed grows by `gradient` per metre downwards.
struct Layer {
    double top, bottom;
    double gradient;
};

/// The layer that a ray is in or, on a boundary, enters. `down`: the sine of its angle below the horizontal.
Layer layer_at(std::span<const SoundSpeedPoint> profile, double depth, double down) {
    const auto below = down >= 0 ? std::ranges::upper_bound(profile, depth, {}, &SoundSpeedPoint::depth)
                                 : std::ranges::lower_bound(profile, depth, {}, &SoundSpeedPoint::depth);
    if (below == profile.begin()) return {-infinity, profile.front().depth, 0};
    const auto above = below - 1;
    if (below == profile.end()) return {above->depth, infinity, 0};
    return {above->depth, below->depth, (below->speed - above->speed) / (below->depth - above->depth)};
}

/// A ray in terms of its angle below the horizontal (rad).
struct Ray {
    double distance, depth, angle;
};

/// Moves along a straight line to the layer's end or for `time`; returns the time it took.
double move_straight(Ray& ray, const Layer& layer, double c, double time) {
    const double sine = std::sin(ray.angle);
    const double end = sine > 0 ? layer.bottom : layer.top;
    const double to_end = sine == 0 || std::isinf(end) ? infinity : (end - ray.depth) / (sine * c);
    const double taken = std::min(time, to_end);
    ray.distance += c * taken * std::cos(ray.angle);
    ray.depth = taken == to_end ? end : ray.depth + c * taken * sine;
    return taken;
}

/// Angle at which a ray of Snell's constant `snell` leaves the layer, and there the depth.
Ray arc_end(const Ray& ray, const Layer& layer, double c, double snell) {
    const auto cosine_at = [&](double depth) { return snell * (c + layer.gradient * (depth - ray.depth)); };
    // A ray turns where the cosine would exceed 1; it then leaves on the side where sound is slower.
    const bool downwards = ray.angle > 0 || (ray.angle == 0 && layer.gradient < 0);
    const double ahead = downwards ? layer.bottom : layer.top, back = downwards ? layer.top : layer.bottom;
    const bool turns = cosine_at(ahead) >= 1;
    const double depth = turns ? back : ahead;
    const double angle = std::acos(std::min(1.0, cosine_at(depth)));
    return {0, depth, downwards != turns ? angle : -angle};
}

/// Along a circle: the angle's inverse Gudermannian, asinh(tan), falls by `gradient` per second.
double move_along_arc(Ray& ray, const Layer& layer, double c, double time) {
    const double snell = std::cos(ray.angle) / c, q = layer.gradient;
    const double now = std::asinh(std::tan(ray.angle));
    Ray end = arc_end(ray, layer, c, snell);
    const double to_end = std::max(0.0, (now - std::asinh(std::tan(end.angle))) / q);
    if (to_end > time) {
        end.angle = std::atan(std::sinh(now - q * time));
        end.depth = ray.depth + (std::cos(end.angle) - std::cos(ray.angle)) / (q * snell);
    }
    end.distance = ray.distance + (std::sin(ray.angle) - std::sin(end.angle)) / (q * snell);
    ray = end;
    return std::min(time, to_end);
}

/// m; 0 for a ray that is above the surface by then.
double displacement_of(std::span<const SoundSpeedPoint> profile, double speed, double depth, double elevation,
                       double range) {
    const RayPoint bent = ray_after(profile, {0, depth, elevation}, range / speed);
    if (bent.depth < 0) return 0;
    return std::hypot(bent.distance - range * std::cos(elevation),
                      bent.depth - depth + range * std::sin(elevation));
}

}  // namespace

double sound_speed_at(std::span<const SoundSpeedPoint> profile, double depth) {
    const auto below = std::ranges::upper_bound(profile, depth, {}, &SoundSpeedPoint::depth);
    if (below == profile.begin()) return profile.front().speed;
    if (below == profile.end()) return profile.back().speed;
    const auto above = below - 1;
    return std::lerp(above->speed, below->speed, (depth - above->depth) / (below->depth - above->depth));
}

std::vector<SoundSpeedPoint> endless_profile(std::span<const SoundSpeedPoint> profile, double reach) {
    std::vector<SoundSpeedPoint> all(profile.begin(), profile.end());
    const auto steepness = [&] { return (all[1].speed - all[0].speed) / (all[1].depth - all[0].depth); };
    const double gradient = all.size() > 1 && all.front().depth <= 0 ? steepness() : 0;
    const double height = gradient == 0 ? reach : std::min(reach, 300 / std::abs(gradient));
    all.insert(all.begin(), {all.front().depth - height, all.front().speed - gradient * height});
    all.push_back({all.back().depth + reach, all.back().speed});
    return all;
}

RayPoint ray_after(std::span<const SoundSpeedPoint> profile, RayPoint start, double time) {
    constexpr double steepest = std::numbers::pi / 2 - 1e-6;  // the arcs of a plumb ray would have no end
    Ray ray{start.distance, start.depth, std::clamp(-start.elevation, -steepest, steepest)};
    for (int step = 0; step < 100'000 && time > 0; ++step) {
        const double c = sound_speed_at(profile, ray.depth);
        Layer layer = layer_at(profile, ray.depth, ray.angle);
        if (ray.angle == 0 && layer.gradient > 0) layer = layer_at(profile, ray.depth, -1);
        time -= std::abs(layer.gradient) < 1e-9 ? move_straight(ray, layer, c, time)
                                                : move_along_arc(ray, layer, c, time);
    }
    return {ray.distance, ray.depth, -ray.angle};
}

StraightRayError straight_ray_error(std::span<const SoundSpeedPoint> profile, double speed, double depth,
                                    double range, double lowest, double highest) {
    StraightRayError worst;
    if (profile.empty()) return worst;
    for (int e = 0; e <= 32; ++e)
        for (int r = 1; r <= 32; ++r) {
            const double elevation = std::lerp(lowest, highest, e / 32.0), at = range * r / 32;
            const double displacement = displacement_of(profile, speed, depth, elevation, at);
            if (displacement > worst.displacement) worst = {displacement, elevation, at};
        }
    return worst;
}

}  // namespace echoloop
