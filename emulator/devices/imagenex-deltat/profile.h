// From the echo of one ping to its 83P. Pure functions.
#pragma once

#include "emulator/devices/imagenex-deltat/settings.h"
#include "protocols/imagenex/delta_t_messages.h"

namespace echoloop::delta_t {

/// What was known when the ping went out, and how long things took.
struct PingRecord {
    Controls controls;
    std::uint32_t number = 0;
    double time = 0;    ///< s, Unix time of the transmission, of the last one where several are averaged
    double period = 0;  ///< s between pings
    double data_latency = 0;  ///< s from the last transmission to the datagram
};

/// `echogram`: of the ping, or the mean of those averaged.
imagenex::Profile83P make_profile(const Echogram& echogram, const PingRecord& ping, const Settings& settings);

/// The bytes on the wire, with floats as the option says.
wire::Bytes to_bytes(const imagenex::Profile83P& profile, const Settings& settings);

}  // namespace echoloop::delta_t
