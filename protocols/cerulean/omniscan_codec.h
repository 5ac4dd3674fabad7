// Messages of an Omniscan 450 to frames and back. Knows no state, time or device.
#pragma once

#include "protocols/cerulean/omniscan_messages.h"
#include "protocols/inspect.h"
#include "protocols/wire/bytes.h"
#include "protocols/wire/result.h"

namespace echoloop::cerulean::omniscan {

/// The message in a frame. Errors carry offsets from the 'B'. The checksum is the framer's business.
wire::Result<Message> parse(const ping::Frame& frame);
/// True for a frame of the older kind of request: the id of a message that has content, without a payload.
bool is_short_request(const ping::Frame& frame);
wire::Bytes encode(const Message& message, std::uint8_t source = 0, std::uint8_t destination = 0);

/// Adds the fields of a frame that an Omniscan 450 knows; false leaves `out` as it is.
bool add_fields(const ping::Frame& frame, inspect::Message& out);
/// Of its own messages, without those that all devices have.
std::vector<wire::Table> tables();

}  // namespace echoloop::cerulean::omniscan
