// How a head that looks down hangs in the water. Pure functions of its pose.
#pragma once

#include <optional>

#include "render/pose.h"

namespace echoloop::delta_t {

/// rad; pitch positive with the bow up, roll with starboard down, heading clockwise from north.
struct Attitude {
    double pitch = 0, roll = 0, heading = 0;
};

/// The sonar's x axis is the acoustic axis, its z axis the bow. Nothing for a head that looks ahead or up.
std::optional<Attitude> attitude_of(const Pose& world_from_sonar);

/// rad to starboard from the axis to straight down in the plane of the fan; 0 if the head does not look down.
double down_bearing(const Pose& world_from_sonar);

}  // namespace echoloop::delta_t
