// The beams of a Doppler log: where they look, and the velocity that follows from what they say. Axes: x
// forward, y to starboard, z down. Pure functions.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "render/pose.h"

namespace echoloop::doppler {

/// Unit vectors of its beams, in its own order.
using Axes = std::vector<Vec3>;
/// Of beams `tilt` rad from z, at azimuths clockwise from x, rad.
Axes beam_axes(double tilt, const std::vector<double>& azimuths);

/// Of a transducer; nothing: it heard no bottom.
struct BeamSpeed {
    double velocity = 0;   ///< m/s along the beam
    double deviation = 0;  ///< m/s, standard
};
using BeamSpeeds = std::vector<std::optional<BeamSpeed>>;

using Covariance = std::array<std::array<double, 3>, 3>;  ///< m^2/s^2

struct Solution {
    Vec3 velocity;  ///< m/s
    Covariance covariance{};
    double error = 0;  ///< m/s, of two pairs of opposite beams: what they disagree by
};

/// By least squares, each beam weighed by its deviation; nothing with fewer than three.
std::optional<Solution> solve(const Axes& axes, const BeamSpeeds& beams);

/// m/s: the root of the largest eigenvalue.
double figure_of_merit(const Covariance& covariance);

/// About z by `angle` rad, clockwise seen from above.
Vec3 turned(Vec3 v, double angle);
Covariance turned(const Covariance& covariance, double angle);

}  // namespace echoloop::doppler
