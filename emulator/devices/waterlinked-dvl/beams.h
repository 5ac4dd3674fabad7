// The four beams of a DVL: where they look, and the velocity that follows from what they say. Axes: x
// forward, y to starboard, z down. Pure functions.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "render/pose.h"

namespace echoloop::waterlinked_dvl {

inline constexpr std::size_t transducers = 4;
inline constexpr double tilt = deg_to_rad(22.5);  ///< of each beam, from z
/// Transducer of each beam of a shot, whose bearings ascend: port aft, port forward, starboard forward,
/// starboard aft.
inline constexpr std::array<std::size_t, transducers> transducer_of_beam{1, 2, 3, 0};

/// Unit vector of a transducer's beam: its azimuth, clockwise from x, is 135, 225, 315 and 45 deg.
Vec3 beam_axis(std::size_t transducer);

/// Of a transducer; nothing: it heard no bottom.
struct BeamSpeed {
    double velocity = 0;   ///< m/s along the beam
    double deviation = 0;  ///< m/s, standard
};
using BeamSpeeds = std::array<std::optional<BeamSpeed>, transducers>;

using Covariance = std::array<std::array<double, 3>, 3>;  ///< m^2/s^2

struct Solution {
    Vec3 velocity;  ///< m/s
    Covariance covariance{};
    double error = 0;  ///< m/s, of four beams: what they disagree by
};

/// By least squares, each beam weighed by its deviation; nothing with fewer than three.
std::optional<Solution> solve(const BeamSpeeds& beams);

/// m/s: the root of the largest eigenvalue.
double figure_of_merit(const Covariance& covariance);

/// About z by `angle` rad, clockwise seen from above.
Vec3 turned(Vec3 v, double angle);
Covariance turned(const Covariance& covariance, double angle);

}  // namespace echoloop::waterlinked_dvl
