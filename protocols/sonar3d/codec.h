// Packets of the Range Image Protocol, RIP1 and RIP2: one datagram, or one record of a .sonar file. Never
// throws for bytes from outside.
#pragma once

#include <optional>
#include <string_view>

#include "protocols/sonar3d/messages.h"
#include "protocols/wire/result.h"

namespace echoloop::sonar3d {

inline constexpr std::size_t longest_packet = 65507;  ///< B, what one datagram holds
inline constexpr std::size_t frame_bytes = 12;        ///< id, length and checksum around the payload

/// Bytes of the packet that begins here, by its id and length; 0 if none does, nothing if more bytes must
/// say so.
std::optional<std::size_t> packet_size(wire::ByteView bytes);
/// Whether id, length and checksum of exactly these bytes are right.
bool is_packet(wire::ByteView bytes);

/// All of `bytes` as one packet.
wire::Result<Packet> parse(wire::ByteView bytes);
wire::Bytes serialise(const Packet& packet);

/// "type.googleapis.com/PACKAGE.RangeImage" and so on.
std::string type_url(std::string_view package, const Message& message);

}  // namespace echoloop::sonar3d
