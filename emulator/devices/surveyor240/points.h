// From the echo of a Surveyor 240-16 to its points, and from the head's pose to what its sensors say. Pure
// functions.
#pragma once

#include <array>
#include <vector>

#include "emulator/devices/surveyor240/ping.h"

namespace echoloop::surveyor240 {

struct Point {
    double angle = 0;  ///< rad from the acoustic axis, positive to port
    double time = 0;   ///< s, two-way
    friend bool operator==(const Point&, const Point&) = default;
};

/// The bottom in every direction that has one whole between start and end, port first; of neighbours the
/// strongest, so that there are no more than `settings.points`.
std::vector<Point> find_points(const Echogram& echogram, const Settings& settings);

/// The world's up direction as the head sees it: x forward, y port, z up. The sonar's x axis is the acoustic
/// axis and looks down; its z axis looks forward.
std::array<float, 3> up_vector(const Pose& world_from_sonar, const Settings& settings);

/// bar, absolute, at the depth of the head.
double water_pressure(const Pose& world_from_sonar);

}  // namespace echoloop::surveyor240
