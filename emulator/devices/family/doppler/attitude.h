// Heading, pitch and roll of a vehicle, and velocities in the axes that follow from them. Pure functions.
#pragma once

#include "render/pose.h"

namespace echoloop::doppler {

/// rad: heading clockwise from north, pitch bow up, roll starboard down.
struct Attitude {
    double heading = 0, pitch = 0, roll = 0;
};

/// Of a body with axes x forward, y to starboard, z down, which `q` turns to axes x east, y south, z down
/// (Measurement::attitude()).
Attitude attitude_of(const Quat& q);
/// Turned by pitch and roll: x along the heading, y to its right, both level, z down.
Vec3 levelled(Vec3 body, const Attitude& attitude);
/// x north, y east, z down.
Vec3 in_world(Vec3 body, const Attitude& attitude);

}  // namespace echoloop::doppler
