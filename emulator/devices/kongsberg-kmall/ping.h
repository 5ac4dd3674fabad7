// The ping of a Kongsberg multibeam: beams, samples, times, and where its beams point in the world. Pure
// functions.
#pragma once

#include "emulator/devices/kongsberg-kmall/settings.h"
#include "render/echogram.h"

namespace echoloop::kongsberg_kmall {

/// Cosine of the outermost beam's angle.
double edge_cosine(const Settings& settings);
/// How far it listens, m: to where the outermost beam is at the depth that is set, or as far as it can.
double listening_range(const Settings& settings);
/// Two-way time of that, s.
double range_time(const Settings& settings);
/// Least time from one ping to the next, s.
double ping_period(const Settings& settings);
Shot make_shot(const Settings& settings, std::uint64_t ping);

/// The surface coordinate system of the head: level, x along its heading, y to starboard, z down.
struct Surface {
    double heading = 0;     ///< rad, clockwise from north
    Vec3 ahead, starboard;  ///< unit vectors in the world
    Vec3 keel;              ///< the same, from deck to keel: down, if the vessel is level

    Vec3 from_world(Vec3 v) const { return {dot(v, ahead), dot(v, starboard), -v.z}; }
};
/// `world_from_sonar` of a head that looks down has its z axis to the bow.
Surface surface_of(const Pose& world_from_sonar);

/// Unit vector of the beam at `bearing` rad (starboard positive) in the surface coordinate system.
Vec3 beam_direction(const Pose& world_from_sonar, const Surface& surface, double bearing);

}  // namespace echoloop::kongsberg_kmall
