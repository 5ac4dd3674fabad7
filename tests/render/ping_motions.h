// A sonar that moves, and the effects by which that shows.
#pragma once

#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop::test {

inline RendererOptions patterned(bool motion = true) {
    RendererOptions options;
    options.effects = Effects::none()
                          .set(Effect::spreading)
                          .set(Effect::beam_pattern)
                          .set(Effect::side_lobes)
                          .set(Effect::motion, motion);
    return options;
}

inline Situation moving(Vec3 velocity, Vec3 turning_deg = {}) {
    Situation situation;
    situation.velocity = velocity;
    situation.turning = {deg_to_rad(turning_deg.x), deg_to_rad(turning_deg.y), deg_to_rad(turning_deg.z)};
    return situation;
}

constexpr double range_of_plates = 50;  ///< m

/// A square that faces a sonar at the origin from `range_of_plates`, `half` m to each side of its middle.
inline Mesh plate(double bearing_deg, double elevation_deg, double half) {
    const Quat turn =
        axis_angle({0, 0, 1}, -deg_to_rad(bearing_deg)) * axis_angle({0, 1, 0}, -deg_to_rad(elevation_deg));
    const auto at = [&](double port, double up) { return rotate(turn, {range_of_plates, port, up}); };
    return quad("plate", at(half, -half), at(-half, -half), at(-half, half), at(half, half));
}

/// Power of the beams from `first` to `last` deg, in the mean over pings.
inline double heard_between(Renderer& renderer, Shot shot, const Situation& situation, double first,
                            double last) {
    double sum = 0;
    for (shot.ping = 0; shot.ping < 32; ++shot.ping) {
        const Echogram e = renderer.render(shot, situation);
        for (std::size_t beam = 0; beam < e.beams(); ++beam) {
            const double bearing = rad_to_deg(shot.bearings[beam % shot.bearings.size()]);
            if (bearing > first && bearing < last) sum += beam_power(e, beam);
        }
    }
    return sum;
}

}  // namespace echoloop::test
