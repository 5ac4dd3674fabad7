// From MAVLink frames to messages. Never opens or waits for anything.
#pragma once

#include <optional>

#include "protocols/mavlink/messages.h"
#include "protocols/wire/bytes.h"

namespace echoloop::mavlink {

/// Empty for other ids. What version 2 has cut off the payload's end is zero; what a later definition has
/// added there is passed over.
std::optional<Message> parse(const Frame& frame);

/// CRC-16/MCRF4XX as MAVLink computes it, over the bytes after the start mark and the seed byte of the
/// message.
std::uint16_t checksum(wire::ByteView bytes, std::uint8_t seed);
/// CRC_EXTRA of a message that parse() knows.
std::optional<std::uint8_t> checksum_seed(std::uint32_t id);

}  // namespace echoloop::mavlink
