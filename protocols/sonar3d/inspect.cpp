#include "protocols/sonar3d/inspect.h"

#include "protocols/inspect_protobuf.h"
#include "protocols/inspect_stream.h"
#include "protocols/sonar3d/codec.h"
#include "protocols/sonar3d/framer.h"
#include "protocols/sonar3d/layouts.h"

namespace echoloop::sonar3d {
namespace {

constexpr std::size_t payload_start = 8;

inspect::Message inspected(const wire::Bytes& bytes, std::size_t offset, std::size_t size) {
    inspect::Message out{.offset = offset, .size = size, .name = "Packet"};
    const auto packet = parse(bytes);
    if (!packet) {
        out.reason = packet.error().what();
        return out;
    }
    const std::string& url = packet->type_url;
    out.name = url.substr(url.find_last_of("./") + 1);
    // Places in a compressed message mean nothing: all fields have those of the payload.
    inspect::ProtobufFields fields(out, payload_start, size - frame_bytes);
    fields.add("id", "", std::string(packet->version == Version::rip1 ? "RIP1" : "RIP2"));
    fields.add("type_url", "", url);
    std::visit(
        [&]<class M>(const M& message) {
            if constexpr (std::is_same_v<M, OtherMessage>)
                fields.add("value", "", inspect::protobuf_value(message.value));
            else
                fields.add_all(message);
        },
        packet->message);
    return out;
}

wire::Table frame_table() {
    const auto row = [](std::optional<std::size_t> offset, std::string_view name, const char* type,
                        std::string_view unit, std::string_view help) {
        return wire::Row{.meta = {name, unit, help}, .type = type, .offset = offset};
    };
    return {.name = "Frame",
            .help = "around each message, little-endian",
            .rows = {row(0, "id", "char[4]", "", "RIP2, or RIP1 of older firmware"),
                     row(4, "length", "u32", "B", "of everything, id, this field and checksum too"),
                     row(8, "payload", "u8[]", "", "a Packet; in RIP2 one Snappy block of it"),
                     row(std::nullopt, "checksum", "u32", "", "CRC-32 (IEEE 802.3) of all bytes before it")}};
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, inspected);
}

bool recognise(wire::ByteView bytes) { return inspect::recognise_stream<Framer>(bytes); }

std::vector<wire::Table> tables() {
    using inspect::protobuf_table_of;
    return {frame_table(),
            protobuf_table_of<Envelope>(),
            protobuf_table_of<Any>(),
            protobuf_table_of<Timestamp>(),
            protobuf_table_of<Header>(),
            protobuf_table_of<RangeImage>(),
            protobuf_table_of<BitmapImage>()};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    const auto packet = parse(bytes);
    return packet ? serialise(*packet) : wire::Bytes{};
}

std::vector<ChecksumPlace> checksums(wire::ByteView bytes) {
    constexpr std::size_t sum_bytes = 4;
    if (!is_packet(bytes)) return {};
    return {{bytes.size() - sum_bytes, sum_bytes}};
}

}  // namespace echoloop::sonar3d
