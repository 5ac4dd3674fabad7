// The datagrams that a Sonic 2024 sends about one ping, and its status. Pure functions; no sockets, no clock.
#pragma once

#include <vector>

#include "emulator/devices/family/multibeam_bottom.h"
#include "emulator/devices/r2sonic/ping.h"
#include "protocols/r2sonic/messages.h"
#include "render/echogram.h"

namespace echoloop::r2sonic_device {

/// What belongs to one ping beside its echogram.
struct PingRecord {
    Controls controls;         ///< as they were at the transmission
    std::uint32_t number = 0;  ///< since power-up
    double time = 0;           ///< s, Unix
    double period = 0;         ///< s since the ping before
    Beams beams;
};

r2sonic::H0 make_h0(const PingRecord& ping, const Settings& settings);

r2sonic::Bth0 make_bth0(const PingRecord& ping, const Settings& settings,
                        const std::vector<multibeam::Detection>& detections, multibeam::TimeGate gate);

/// The image of AID0: the first datagram, then the sections with all beams and ascending bins. Empty without
/// an image.
std::vector<r2sonic::Packet> make_image(const PingRecord& ping, const Settings& settings,
                                        const Echogram& echogram);

r2sonic::Sth0 head_status(const Settings& settings, double unix_time);
r2sonic::Sts0 sim_status(const Settings& settings, double unix_time);

}  // namespace echoloop::r2sonic_device
