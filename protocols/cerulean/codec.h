// The messages of one Cerulean sonar to frames and back. Knows no state, time or device.
#pragma once

#include <variant>

#include "protocols/inspect.h"
#include "protocols/ping/common_messages.h"
#include "protocols/wire/bytes.h"
#include "protocols/wire/result.h"

namespace echoloop::cerulean {

/// Message: the variant of the sonar's messages; <sonar>_codec.h names those that there are.
template <class Message>
struct Codec {
    /// The message in a frame. Errors carry offsets from the 'B'. The checksum is the framer's business.
    static wire::Result<Message> parse(const ping::Frame& frame);
    /// True for a frame of the older kind of request: the id of a message that has content, without a
    /// payload.
    static bool is_short_request(const ping::Frame& frame);
    static wire::Bytes encode(const Message& message, std::uint8_t source = 0, std::uint8_t destination = 0);
    /// Adds the fields of a frame that the sonar knows; false leaves `out` as it is.
    static bool add_fields(const ping::Frame& frame, inspect::Message& out);
};

template <class... M>
wire::Bytes encode(const std::variant<M...>& message, std::uint8_t source = 0, std::uint8_t destination = 0) {
    return Codec<std::variant<M...>>::encode(message, source, destination);
}

}  // namespace echoloop::cerulean
