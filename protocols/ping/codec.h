// Ping messages to frames and back, by the tables of the layouts. Knows no state, time or device.
#pragma once

#include <string>

#include "protocols/ping/messages.h"
#include "protocols/wire/bytes.h"
#include "protocols/wire/result.h"

namespace echoloop::ping {

/// The message in a frame. Errors carry offsets from the 'B'. The checksum is the framer's business.
wire::Result<Message> parse(const Frame& frame);

/// True for a frame of the older kind of request: the id of a message that has content, without a payload.
bool is_short_request(const Frame& frame);

/// Header, payload and checksum of a message.
Frame make_frame(const Message& message, std::uint8_t source = 0, std::uint8_t destination = 0);
/// The older kind of request for message `id`.
Frame short_request(Id id);

/// All bytes of a frame as it is, whatever its checksum says. A payload beyond 65535 bytes is cut.
wire::Bytes encode(const Frame& frame);
wire::Bytes encode(const Message& message, std::uint8_t source = 0, std::uint8_t destination = 0);

/// The sum of all bytes of a frame but its last two, modulo 65536.
std::uint16_t checksum(wire::ByteView bytes);

Id id_of(const Message& message);
/// "DeviceData", or "id 99" for an id without a name.
std::string name_of(Id id);

}  // namespace echoloop::ping
