// The packets of a Norbit WBMS about one ping. Pure functions; no clock.
#pragma once

#include "emulator/devices/norbit-wbms/ping.h"

namespace echoloop::norbit_device {

/// What belongs to one ping beside its echogram.
struct PingRecord {
    Controls controls;
    Plan plan;
    std::uint32_t number = 0;  ///< since power-up
    double transmitted = 0;    ///< s, by the sonar's time source
    Time since_start{};        ///< the same on the run's clock
};

/// `sent`: s, by the sonar's time source.
Bytes bathymetry_packet(const PingRecord& ping, const Settings& settings, const Echogram& echogram,
                        double sent);

/// `peak` becomes the greatest sample as part of full scale, before it is cut.
Bytes water_column_packet(const PingRecord& ping, const Settings& settings, const Echogram& echogram,
                          double sent, double& peak);

}  // namespace echoloop::norbit_device
