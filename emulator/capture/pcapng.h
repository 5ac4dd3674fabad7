// The blocks of a pcapng file (draft-ietf-opsawg-pcapng) as bytes, little endian, times in nanoseconds.
// Writes no file and knows no protocol.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "emulator/contract/device.h"

namespace echoloop::pcapng {

/// What the packets of an interface begin with; numbers from the registry of LINKTYPE_ values.
enum class LinkType : std::uint16_t {
    raw_ip = 101,       ///< an IPv4 header
    rtac_serial = 250,  ///< twelve bytes of time, event and modem lines, then the bytes on the line
};

/// As the emulated device sees it.
enum class Direction : std::uint8_t { received = 1, sent = 2 };

/// Since 1970 UTC.
using WallTime = std::chrono::nanoseconds;

/// The first block of a file. `application` is who wrote it, e.g. "echoloop 0.1.0".
Bytes section_header(const std::string& application);

/// Interfaces count from 0 in the order of their blocks.
Bytes interface_description(LinkType type, const std::string& name, const std::string& description);

struct Packet {
    std::uint32_t interface = 0;
    WallTime time{};
    Direction direction = Direction::sent;
    std::string comment;  ///< "": none
};
Bytes enhanced_packet(const Packet& packet, ByteView bytes);

}  // namespace echoloop::pcapng
