// Bytes of the messages of an ARIS to structs and back. Knows no transport; never throws.
#pragma once

#include <optional>

#include "protocols/aris/header.h"
#include "protocols/aris/messages.h"

namespace echoloop::aris {

inline constexpr std::size_t length_bytes = 4;       ///< before a command
inline constexpr std::size_t longest_command = 256;  ///< B behind its length; real ones have less than 70

/// One UDP datagram each.
wire::Bytes encode(const Availability& message);
wire::Bytes encode(const FramePart& message);
wire::Bytes encode(const FramePartAck& message);
/// With its length.
wire::Bytes encode(const Command& message);
/// header_bytes long.
wire::Bytes encode(const FrameHeader& header);

/// Nothing if the bytes are no protobuf message.
std::optional<Availability> parse_availability(wire::ByteView bytes);
std::optional<FramePart> parse_frame_part(wire::ByteView bytes);
std::optional<FramePartAck> parse_frame_part_ack(wire::ByteView bytes);
/// Behind its length. Nothing, too, if the part that its type names is not there; ping and home focus need
/// none.
std::optional<Command> parse_command(wire::ByteView bytes);
/// Nothing if there are less than header_bytes; what follows them is padding.
std::optional<FrameHeader> parse_frame_header(wire::ByteView bytes);

}  // namespace echoloop::aris
