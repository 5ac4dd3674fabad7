// What the sensors in an ARIS say of where it is: pressure, compass and accelerometer. Pure functions.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "render/pose.h"

namespace echoloop::aris_device {

/// Of water, against fresh water at 4 degC: by salinity in ppt and every 5 degC from 0 on, the nearest
/// counts. The maker's table (aris-integration-sdk, Depth).
inline double relative_density(std::uint32_t salinity, double temperature) {
    constexpr std::array<double, 7> fresh{1.000, 1.000, 1.000, 0.999, 0.998, 0.997, 0.996};
    constexpr std::array<double, 7> brackish{1.012, 1.012, 1.011, 1.011, 1.010, 1.008, 1.007};
    constexpr std::array<double, 7> salt{1.028, 1.028, 1.027, 1.026, 1.025, 1.023, 1.022};
    const auto& row = salinity >= 35 ? salt : salinity >= 15 ? brackish : fresh;
    const double step = std::clamp(std::round(temperature / 5), 0.0, static_cast<double>(row.size() - 1));
    return row[static_cast<std::size_t>(step)];
}

/// psi, absolute, at `depth` m: what the maker's hosts turn back into that depth.
inline double pressure_at(double depth, std::uint32_t salinity, double temperature) {
    constexpr double air = 14.6959, metres_per_psi = 0.702398;
    return air + std::max(0.0, depth) * relative_density(salinity, temperature) / metres_per_psi;
}

/// deg: heading clockwise from north, 0 to 360; pitch nose up; roll starboard down. Acceleration in g: the
/// sine of the pitch, that of the roll, and -1 when level, as in the maker's sample file.
struct Attitude {
    double heading = 0, pitch = 0, roll = 0;
    Vec3 acceleration;
};
inline Attitude attitude_of(const Quat& world_from_sonar) {
    const Vec3 ahead = rotate(world_from_sonar, {1, 0, 0}), port = rotate(world_from_sonar, {0, 1, 0});
    const Vec3 up = rotate(world_from_sonar, {0, 0, 1});
    const double heading = rad_to_deg(std::atan2(ahead.x, ahead.y));
    return {heading < 0 ? heading + 360 : heading,
            rad_to_deg(std::asin(std::clamp(ahead.z, -1.0, 1.0))),
            rad_to_deg(std::atan2(port.z, up.z)),
            {ahead.z, port.z, -up.z}};
}

}  // namespace echoloop::aris_device
