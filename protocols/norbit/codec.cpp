#include "protocols/norbit/codec.h"

#include <algorithm>

#include "protocols/norbit/layouts.h"
#include "protocols/wire/crc.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::norbit {
namespace {

constexpr std::size_t type_at = 4, size_at = 8, crc_at = 20;
constexpr std::size_t bathymetry_head = 112;  // B before the points, with the header

bool carries_crc(Type type) { return type == Type::bathymetry || type == Type::water_column; }

std::size_t least_payload(Type type) {
    return (type == Type::bathymetry ? bathymetry_head : water_column_head) - header_bytes;
}

template <class T>
void put(wire::Bytes& packet, std::size_t at, T value) {
    wire::store<wire::ByteOrder::little>(value, packet.data() + at);
}

template <class M>
wire::Bytes without_crc(Type type, std::uint32_t version, const M& message) {
    Header header;
    header.type = type;
    header.version = version;
    wire::Writer writer;
    wire::write_fields(writer, header);
    writer.counts.message(message);
    wire::write_fields(writer, message);
    return std::move(writer.out);
}

void put_size(wire::Bytes& packet) { put(packet, size_at, static_cast<std::uint32_t>(packet.size())); }

template <class M>
wire::Result<Message> parse_as(const wire::Bytes& payload) {
    auto message = wire::parse<M>(payload);
    if (!message) return message.error();
    return Message(*std::move(message));
}

}  // namespace

bool has_right_crc(const Header& header, wire::ByteView payload) {
    return !carries_crc(header.type) || header.crc == wire::crc32(payload);
}

std::optional<Header> plausible_header(wire::ByteView bytes) {
    if (bytes.size() < header_bytes) return std::nullopt;
    const auto header = wire::parse<Header>(bytes.first(header_bytes));
    if (!header || header->reserved != 0) return std::nullopt;
    const auto known = [&](const wire::NamedValue& v) {
        return v.value == static_cast<std::uint32_t>(header->type);
    };
    if (std::none_of(std::begin(type_names), std::end(type_names), known)) return std::nullopt;
    const std::size_t least = header_bytes + least_payload(header->type);
    if (header->size < least || header->size > max_packet) return std::nullopt;
    return *header;
}

wire::Result<Message> parse(const Frame& frame) {
    switch (frame.header.type) {
        case Type::bathymetry:
            return parse_as<Bathymetry>(frame.payload);
        case Type::water_column:
        case Type::snippet:
        case Type::side_scan:
            return parse_as<WaterColumn>(frame.payload);
    }
    return wire::Error{"Header", "type", type_at, wire::Reason::unknown_message};
}

wire::Bytes encode(const Message& message, std::uint32_t version, std::optional<Type> type) {
    const bool points = std::holds_alternative<Bathymetry>(message);
    const Type usual = points ? Type::bathymetry : Type::water_column;
    wire::Bytes packet =
        std::visit([&](const auto& m) { return without_crc(type.value_or(usual), version, m); }, message);
    put_size(packet);
    if (carries_crc(type.value_or(usual))) close(packet);
    return packet;
}

wire::Bytes open(const WaterColumn& message, std::uint32_t version) {
    wire::Bytes packet = without_crc(Type::water_column, version, message);
    const std::size_t cells = std::size_t{message.samples} * message.beams;
    packet.resize(water_column_head + cells * bytes_of(message.sample) + 4 * std::size_t{message.beams});
    put_size(packet);
    return packet;
}

void close(wire::Bytes& packet) {
    put(packet, crc_at, wire::crc32(wire::ByteView(packet).subspan(header_bytes)));
}

std::string name_of(const Header& header) {
    for (const wire::NamedValue& known : type_names)
        if (known.value == static_cast<std::uint32_t>(header.type)) return std::string(known.name);
    return "type " + std::to_string(static_cast<std::uint32_t>(header.type));
}

std::size_t bytes_of(Sample sample) {
    switch (sample) {
        case Sample::u8:
        case Sample::s8:
            return 1;
        case Sample::u16:
        case Sample::s16:
            return 2;
        case Sample::u32:
        case Sample::s32:
        case Sample::f32:
            return 4;
        case Sample::u64:
        case Sample::s64:
        case Sample::f64:
            return 8;
    }
    return 0;
}

std::optional<Image> image_of(const WaterColumn& m) {
    const std::size_t size = bytes_of(m.sample), most = m.tail.size();
    if (size == 0 || m.beams > most || m.samples > most) return std::nullopt;
    const std::size_t samples = std::size_t{m.samples} * m.beams * size, angles = 4 * std::size_t{m.beams};
    if (samples + angles > most) return std::nullopt;
    const wire::ByteView tail(m.tail);
    return Image{size, tail.first(samples), tail.subspan(samples, angles)};
}

}  // namespace echoloop::norbit
