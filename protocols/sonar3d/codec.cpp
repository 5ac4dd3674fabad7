#include "protocols/sonar3d/codec.h"

#include <algorithm>

#include "protocols/sonar3d/layouts.h"
#include "protocols/sonar3d/snappy.h"
#include "protocols/sonar3d/words.h"
#include "protocols/wire/crc.h"

namespace echoloop::sonar3d {
namespace {

namespace protobuf = wire::protobuf;

constexpr std::string_view id_start = "RIP";
constexpr std::size_t length_at = 4, payload_at = 8, crc_bytes = 4;

void put_word(std::uint32_t value, wire::Bytes& out) {
    out.resize(out.size() + 4);
    wire::store<wire::ByteOrder::little>(value, out.data() + out.size() - 4);
}

/// As far as there are bytes.
bool has_id(wire::ByteView bytes) {
    for (std::size_t i = 0; i < std::min(bytes.size(), id_start.size()); ++i)
        if (bytes[i] != static_cast<std::uint8_t>(id_start[i])) return false;
    return bytes.size() < 4 || bytes[3] == '1' || bytes[3] == '2';
}

wire::Error fault(std::string_view field, std::size_t at, wire::Reason reason) {
    return {"Packet", field, at, reason};
}

std::optional<wire::Error> frame_fault(wire::ByteView bytes) {
    using wire::Reason;
    if (!has_id(bytes)) return fault("id", 0, Reason::wrong_constant);
    if (bytes.size() < frame_bytes) return fault("length", bytes.size(), Reason::truncated);
    const std::size_t length = word_at(bytes, length_at);
    if (length < frame_bytes || length > longest_packet) return fault("length", 4, Reason::wrong_size);
    if (length > bytes.size()) return fault("payload", bytes.size(), Reason::truncated);
    if (length < bytes.size()) return fault("checksum", length, Reason::trailing_bytes);
    const std::size_t at = length - crc_bytes;
    if (wire::crc32(bytes.first(at)) != word_at(bytes, at))
        return fault("checksum", at, Reason::wrong_constant);
    return std::nullopt;
}

template <class M>
bool read_into(wire::ByteView value, Message& message) {
    return protobuf::read(value, message.emplace<M>());
}

bool is_named(std::string_view url, std::string_view name) {
    return url.ends_with(name) && (url.size() == name.size() || url[url.size() - name.size() - 1] == '.');
}

bool read_message(const Any& any, Message& message) {
    if (is_named(any.type_url, protobuf::layout<RangeImage>.name))
        return read_into<RangeImage>(any.value, message);
    if (is_named(any.type_url, protobuf::layout<BitmapImage>.name))
        return read_into<BitmapImage>(any.value, message);
    message = OtherMessage{any.value};
    return true;
}

}  // namespace

std::optional<std::size_t> packet_size(wire::ByteView bytes) {
    if (!has_id(bytes)) return 0;
    if (bytes.size() < payload_at) return std::nullopt;
    const std::size_t length = word_at(bytes, length_at);
    return length < frame_bytes || length > longest_packet ? 0 : length;
}

bool is_packet(wire::ByteView bytes) { return !frame_fault(bytes); }

wire::Result<Packet> parse(wire::ByteView bytes) {
    if (const auto error = frame_fault(bytes)) return *error;
    Packet packet{bytes[3] == '1' ? Version::rip1 : Version::rip2, {}, {}};
    const wire::ByteView payload = bytes.subspan(payload_at, bytes.size() - frame_bytes);
    wire::Bytes plain;
    if (packet.version == Version::rip2) {
        auto block = snappy_uncompress(payload);
        if (!block) return fault("payload", payload_at, wire::Reason::wrong_size);
        plain = *std::move(block);
    }
    Envelope envelope;
    if (!protobuf::read(packet.version == Version::rip2 ? wire::ByteView(plain) : payload, envelope))
        return fault("msg", payload_at, wire::Reason::truncated);
    if (!read_message(envelope.msg, packet.message))
        return fault("msg.value", payload_at, wire::Reason::truncated);
    packet.type_url = std::move(envelope.msg.type_url);
    return packet;
}

wire::Bytes serialise(const Packet& packet) {
    Envelope envelope;
    envelope.msg.type_url = packet.type_url;
    envelope.msg.value = std::visit(
        []<class M>(const M& message) {
            if constexpr (std::is_same_v<M, OtherMessage>)
                return message.value;
            else
                return protobuf::write(message);
        },
        packet.message);
    wire::Bytes payload = protobuf::write(envelope);
    const bool plain = packet.version == Version::rip1;
    if (!plain) payload = snappy_compress(payload);
    wire::Bytes out;
    out.reserve(payload.size() + frame_bytes);
    for (const char c : {'R', 'I', 'P', plain ? '1' : '2'}) out.push_back(static_cast<std::uint8_t>(c));
    put_word(static_cast<std::uint32_t>(payload.size() + frame_bytes), out);
    out.insert(out.end(), payload.begin(), payload.end());
    put_word(wire::crc32(out), out);
    return out;
}

std::string type_url(std::string_view package, const Message& message) {
    const std::string_view name = std::holds_alternative<RangeImage>(message)
                                      ? protobuf::layout<RangeImage>.name
                                      : protobuf::layout<BitmapImage>.name;
    return "type.googleapis.com/" + std::string(package) + '.' + std::string(name);
}

}  // namespace echoloop::sonar3d
