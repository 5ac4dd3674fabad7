// The messages that an Oculus sends: ping results and its status. Pure functions; no sockets, no clock.
#pragma once

#include "emulator/devices/oculus/request.h"

namespace echoloop::oculus_device {

/// What belongs to one ping beside its echogram.
struct PingRecord {
    Request request;
    Plan plan;
    std::uint32_t number = 0;  ///< since power-up
    Time time{};               ///< of the transmission, since power-up
};

/// A v1 or v2 result, as the request was.
Bytes make_result(const PingRecord& ping, const Settings& settings, const Echogram& echogram);

/// `own` is where the sonar listens, `client` who is connected (0: nobody); `depth` in m.
Bytes make_status(const Settings& settings, std::uint32_t own, std::uint32_t client, double depth, Time now);

Bytes make_dummy(const Settings& settings);

}  // namespace echoloop::oculus_device
