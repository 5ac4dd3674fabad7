// A frame of an ARIS from an echogram: samples, header, and the datagrams that carry them. Pure functions; no
// sockets, no clock.
#pragma once

#include <span>

#include "emulator/devices/aris/acoustics.h"
#include "protocols/aris/header.h"

namespace echoloop::aris_device {

/// What belongs to one frame beside its echogram.
struct FrameRecord {
    std::uint32_t number = 0;  ///< from 1 for each controller
    aris::SetAcoustics acoustics;
    bool telephoto = false;
    std::uint32_t salinity = 0;     ///< ppt
    std::uint32_t constrained = 0;  ///< cookie of the last settings that were made to fit
    std::uint32_t invalid = 0;      ///< cookie of the last settings that were refused
    aris::PacketDelay delay;        ///< as the controller set it
    Time time{};                    ///< of the transmission, since power-up
    std::uint64_t clock = 0;        ///< us since 1970, the same by the sonar's own clock

    std::size_t beams() const { return aris::find_ping_mode(acoustics.ping_mode)->beams; }
    std::size_t bytes() const { return beams() * acoustics.samples; }
};

/// `depth` in m.
aris::FrameHeader make_header(const FrameRecord& frame, const Settings& settings, double depth);

/// One byte for each sample, in the order of the settings; `out` holds exactly as many.
void write_samples(const Echogram& echogram, const FrameRecord& frame, const Settings& settings,
                   std::span<std::uint8_t> out);

/// s between parts.
double part_delay(const FrameRecord& frame, const Settings& settings);
std::size_t part_count(const FrameRecord& frame, const Settings& settings);
/// The datagrams, in order.
std::vector<Bytes> make_parts(const FrameRecord& frame, const Settings& settings, const Echogram& echogram);

}  // namespace echoloop::aris_device
