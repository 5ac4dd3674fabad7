// The datagrams that a Sonic 20xx sends about one ping, and its status. Pure functions; no sockets, no clock.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "emulator/devices/family/multibeam/bottom.h"
#include "emulator/devices/r2sonic/inputs.h"
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
    Time since_start{};        ///< on the run's clock
    Attitude attitude;         ///< as the head knew it
    Beams beams;
};

r2sonic::H0 make_h0(const PingRecord& ping, const Settings& settings);
/// That of packets whose samples are the bins of the echogram: its sample rate is theirs.
r2sonic::H0 make_h0(const PingRecord& ping, const Settings& settings, const Echogram& echogram);

r2sonic::Bth0 make_bth0(const PingRecord& ping, const Settings& settings, const Echogram& echogram,
                        const std::vector<multibeam::Detection>& detections,
                        const std::vector<multibeam::TimeGate>& gates, const r2sonic::G0& gate);

/// The beams that image and water column show, of as many as the bottom has points: all of 256, and of more
/// 256 evenly from the first to the last.
std::vector<std::size_t> shown_beams(std::size_t beams);
/// Their angles.
r2sonic::A1 make_a1(const PingRecord& ping, const std::vector<std::size_t>& shown);

/// AID0: the first datagram, then the sections with all beams that are shown and ascending bins. Empty
/// without an image.
std::vector<Bytes> image_datagrams(const PingRecord& ping, const Settings& settings,
                                   const Echogram& echogram);

/// WCD0: the first datagram, then sections with all beams and ascending samples. Empty if it is off.
std::vector<Bytes> water_column_datagrams(const PingRecord& ping, const Settings& settings,
                                          const Echogram& echogram);

/// SNI0: a snippet for every point with a bottom, its number that of the point. Empty if they are off.
std::vector<Bytes> snippet_datagrams(const PingRecord& ping, const Settings& settings,
                                     const Echogram& echogram,
                                     const std::vector<multibeam::Detection>& detections);

/// TPX0: what is strongest on either side at each range, within the gates of all beams together if TPG0 says
/// so. Empty if it is off.
std::vector<Bytes> truepix_datagrams(const PingRecord& ping, const Settings& settings,
                                     const Echogram& echogram, const std::vector<multibeam::TimeGate>& gates);

/// What a status tells of the moment.
struct Health {
    double unix_time = 0;
    Time since_start{};
    Attitude attitude;
    std::uint32_t received = 0, sent = 0;  ///< datagrams
    bool head_on = true;
    bool sync_pulses = false;
    std::optional<MotionReading> motion{};  ///< of the SIM's input, where there is one
    std::optional<double> sound_speed{};    ///< m/s, the same
    std::array<Lamp, input_count> lamps{Lamp::good, Lamp::good, Lamp::good};  ///< by Input
};
r2sonic::Sth0 head_status(const Settings& settings, const Health& health);
r2sonic::Sts0 sim_status(const Settings& settings, const Health& health);

/// Largest datagram that fits an Ethernet frame, bytes.
inline constexpr std::size_t frame_payload = 1472;

}  // namespace echoloop::r2sonic_device
