// The messages of a Surveyor 240-16 about one ping. Pure functions; no clock.
#pragma once

#include "emulator/devices/surveyor240/points.h"

namespace echoloop::surveyor240 {

/// What belongs to one ping beside its points.
struct PingRecord {
    Plan plan;
    std::uint32_t number = 0;  ///< since power-up
    std::uint32_t at = 0;      ///< ms since power-up, of the transmission
    std::uint64_t utc = 0;     ///< ms since 1970, of the transmission; 0: not known
    std::array<float, 3> up{};
    cerulean::surveyor::WaterStats water;
};

cerulean::surveyor::AtofPointData atof_message(const PingRecord& ping, const std::vector<Point>& points);
cerulean::surveyor::YzPointData yz_message(const PingRecord& ping, const std::vector<Point>& points);

/// m by the host's speed of sound.
double slant_range(const Point& point, const Plan& plan);

}  // namespace echoloop::surveyor240
