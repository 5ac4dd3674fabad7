// What a codec of one Cerulean sonar is made of: a table of its messages, walked to read and to write. For
// .cpp files only, since the table pulls in the expensive headers. Knows no state, time or device.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <variant>

#include "protocols/cerulean/layouts.h"
#include "protocols/inspect_stream.h"
#include "protocols/ping/codec.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::cerulean {

/// One row per alternative of Message, in its order.
template <class Message>
struct Row {
    Id id;
    Result<Message> (*parse)(ByteView payload);
};

template <class Message, class M>
Result<Message> parse_as(ByteView payload) {
    auto message = wire::parse<M>(payload);
    if (!message) return message.error();
    return Message(*std::move(message));
}

template <class Message>
const Row<Message>* find_row(std::span<const Row<Message>> rows, ping::Id id) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row<Message>& r) {
        return static_cast<std::uint16_t>(r.id) == static_cast<std::uint16_t>(id);
    });
    return row == rows.end() ? nullptr : &*row;
}

template <class Message>
Result<Message> parse_by(std::span<const Row<Message>> rows, const ping::Frame& frame) {
    const auto* row = find_row(rows, frame.header.id);
    if (row == nullptr) return Error{"Frame", "id", 4, Reason::unknown_message};
    return row->parse(frame.payload);
}

/// A frame of the older kind of request: the id of a message that has content, without a payload.
template <class Message>
bool is_short_request_by(std::span<const Row<Message>> rows, const ping::Frame& frame) {
    const auto* row = find_row(rows, frame.header.id);
    return frame.payload.empty() && row != nullptr && !row->parse({}).has_value();
}

template <class Message>
wire::Bytes encode_by(std::span<const Row<Message>> rows, const Message& message, std::uint8_t source,
                      std::uint8_t destination) {
    ping::Frame frame{{static_cast<ping::Id>(rows[message.index()].id), source, destination}, {}, 0};
    frame.payload = std::visit([](const auto& m) { return wire::serialise(m); }, message);
    frame.checksum = ping::checksum(ping::encode(frame));
    return ping::encode(frame);
}

/// Adds the fields of a frame whose id is one of these; false leaves `out` as it is.
template <class Message>
bool inspect_by(std::span<const Row<Message>> rows, const ping::Frame& frame, inspect::Message& out) {
    if (find_row(rows, frame.header.id) == nullptr) return false;
    const auto message = parse_by(rows, frame);
    if (message) {
        std::visit([&](const auto& m) { inspect::add_fields(out, m); }, *message);
    } else if (is_short_request_by(rows, frame)) {
        out.name += " request";
    } else {
        out.reason = message.error().what();
    }
    return true;
}

}  // namespace echoloop::cerulean
