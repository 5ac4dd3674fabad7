// How rays bend in layered water, and how far off straight ones therefore are. Pure functions of a profile of
// sound speed.
#pragma once

#include <span>
#include <vector>

#include "render/water.h"

namespace echoloop {

/// m/s at a depth in m: linear between the points, constant beyond them. The profile has a point at least.
double sound_speed_at(std::span<const SoundSpeedPoint> profile, double depth);

/// A profile that goes on for `reach` m: constant below, and above the surface as steep as just below it, so
/// that rays that only just pass above it continue those that do not.
std::vector<SoundSpeedPoint> endless_profile(std::span<const SoundSpeedPoint> profile, double reach);

/// Where a ray is, and where it heads.
struct RayPoint {
    double distance = 0;   ///< m, horizontal
    double depth = 0;      ///< m below the surface, positive down
    double elevation = 0;  ///< rad, positive upwards, within +-pi/2
};

/// The ray after `time` s more. In a layer whose sound speed has the gradient q it is an exact arc of radius
/// c / (|q| cos e) (Snell's law; Jensen et al., Computational Ocean Acoustics, 2011, section 3.3). The
/// surface and the bottom do not stop it.
RayPoint ray_after(std::span<const SoundSpeedPoint> profile, RayPoint start, double time);

/// The largest distance between where straight rays place an echo and where it really comes from.
struct StraightRayError {
    double displacement = 0;  ///< m
    double elevation = 0;     ///< rad, of the ray that has it
    double range = 0;         ///< m, slant, at which it has it
};

/// Compares rays from `depth` m with straight ones of the same travel time at the sound speed `speed` m/s, up
/// to the slant range `range` m, for 33 elevations from `lowest` to `highest` (rad, positive upwards) and 32
/// ranges; a ray that leaves through the surface counts as far as there. 0 for a profile of no points.
StraightRayError straight_ray_error(std::span<const SoundSpeedPoint> profile, double speed, double depth,
                                    double range, double lowest, double highest);

}  // namespace echoloop
