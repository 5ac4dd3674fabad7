// How a codec of one Cerulean sonar reads and writes: by a table made from the ids of its messages. For .cpp
// files only, since the table pulls in the expensive headers. Knows no state, time or device.
#pragma once

#include <algorithm>
#include <iterator>
#include <utility>

#include "protocols/cerulean/codec.h"
#include "protocols/cerulean/layouts.h"
#include "protocols/inspect_stream.h"
#include "protocols/ping/codec.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::cerulean {

/// The id of a message. A sonar has them for its own in its own namespace.
constexpr Id id_of(Tag<ping::Ack>) { return Id::ack; }
constexpr Id id_of(Tag<ping::Nack>) { return Id::nack; }
constexpr Id id_of(Tag<ping::AsciiText>) { return Id::ascii_text; }
constexpr Id id_of(Tag<ping::DeviceInformation>) { return Id::device_information; }
constexpr Id id_of(Tag<ping::ProtocolVersion>) { return Id::protocol_version; }
constexpr Id id_of(Tag<ping::GeneralRequest>) { return Id::general_request; }
constexpr Id id_of(Tag<JsonWrapper>) { return Id::json_wrapper; }
constexpr Id id_of(Tag<SetSpeedOfSound>) { return Id::set_speed_of_sound; }
constexpr Id id_of(Tag<GeneralSpeedOfSound>) { return Id::general_speed_of_sound; }

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

/// One row per alternative of Message, in its order.
template <class Message>
struct Rows;
template <class... M>
struct Rows<std::variant<M...>> {
    static constexpr Row<std::variant<M...>> all[] = {{id_of(Tag<M>{}), parse_as<std::variant<M...>, M>}...};
};

template <class Message>
const Row<Message>* find_row(ping::Id id) {
    const auto& rows = Rows<Message>::all;
    const auto* row = std::find_if(std::begin(rows), std::end(rows), [&](const Row<Message>& r) {
        return static_cast<std::uint16_t>(r.id) == static_cast<std::uint16_t>(id);
    });
    return row == std::end(rows) ? nullptr : row;
}

template <class Message>
Result<Message> Codec<Message>::parse(const ping::Frame& frame) {
    const auto* row = find_row<Message>(frame.header.id);
    if (row == nullptr) return Error{"Frame", "id", 4, Reason::unknown_message};
    return row->parse(frame.payload);
}

template <class Message>
bool Codec<Message>::is_short_request(const ping::Frame& frame) {
    const auto* row = find_row<Message>(frame.header.id);
    return frame.payload.empty() && row != nullptr && !row->parse({}).has_value();
}

template <class Message>
wire::Bytes Codec<Message>::encode(const Message& message, std::uint8_t source, std::uint8_t destination) {
    const auto id = static_cast<ping::Id>(Rows<Message>::all[message.index()].id);
    ping::Frame frame{{id, source, destination}, {}, 0};
    frame.payload = std::visit([](const auto& m) { return wire::serialise(m); }, message);
    frame.checksum = ping::checksum(ping::encode(frame));
    return ping::encode(frame);
}

template <class Message>
bool Codec<Message>::add_fields(const ping::Frame& frame, inspect::Message& out) {
    if (find_row<Message>(frame.header.id) == nullptr) return false;
    const auto message = parse(frame);
    if (message) {
        std::visit([&](const auto& m) { inspect::add_fields(out, m); }, *message);
    } else if (is_short_request(frame)) {
        out.name += " request";
    } else {
        out.reason = message.error().what();
    }
    return true;
}

}  // namespace echoloop::cerulean
