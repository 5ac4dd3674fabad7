// A frame of an ARIS from an echogram: samples, header, and the datagrams that carry them. Pure functions; no
// sockets, no clock.
#pragma once

#include <span>

#include "emulator/devices/aris/acoustics.h"
#include "emulator/devices/aris/focus.h"
#include "protocols/aris/header.h"

namespace echoloop::aris_device {

/// Of the last settings that were taken as they were, made to fit, and refused; 0: none so far. A controller
/// counts its cookies up, so the largest of the three is that of its last settings.
struct Cookies {
    std::uint32_t applied = 0, constrained = 0, invalid = 0;
};

/// What belongs to one frame beside its echogram.
struct FrameRecord {
    std::uint32_t number = 0;  ///< from 1 for each controller
    aris::SetAcoustics acoustics;
    bool telephoto = false;
    std::uint32_t salinity = 0;  ///< ppt
    Cookies cookies;
    aris::PacketDelay delay;  ///< as the controller set it
    FocusMotor focus;
    Time time{};              ///< of the transmission, since power-up
    std::uint64_t clock = 0;  ///< us since 1970, the same by the sonar's own clock

    std::size_t beams() const { return aris::find_ping_mode(acoustics.ping_mode)->beams; }
    std::size_t bytes() const { return beams() * acoustics.samples; }
};

aris::FrameHeader make_header(const FrameRecord& frame, const Settings& settings,
                              const Pose& world_from_sonar);

/// One byte for each sample, in the order of the settings; `out` holds exactly as many.
void write_samples(const Echogram& echogram, const FrameRecord& frame, const Settings& settings,
                   std::span<std::uint8_t> out);

/// s between parts.
double part_delay(const FrameRecord& frame, const Settings& settings);
std::size_t part_count(const FrameRecord& frame, const Settings& settings);
/// The datagrams, in order.
std::vector<Bytes> make_parts(const FrameRecord& frame, const Settings& settings, const Echogram& echogram);

}  // namespace echoloop::aris_device
