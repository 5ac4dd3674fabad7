#include "protocols/norbit/inspect.h"

#include "protocols/inspect_stream.h"
#include "protocols/norbit/codec.h"
#include "protocols/norbit/framer.h"
#include "protocols/norbit/layouts.h"

namespace echoloop::norbit {
namespace {

const char* fault_of(const Bathymetry&) { return ""; }
const char* fault_of(const WaterColumn& message) {
    return image_of(message) ? "" : "rows, columns and sample type do not fit the packet's size";
}

inspect::Message inspected(const Frame& frame, std::size_t offset, std::size_t size) {
    inspect::Message out{.offset = offset, .size = size};
    out.name = name_of(frame.header);
    inspect::add_fields(out, frame.header);
    const auto message = parse(frame);
    if (!message) {
        out.reason = message.error().what();
        return out;
    }
    std::visit(
        [&](const auto& m) {
            inspect::add_fields(out, m);
            out.reason = fault_of(m);
        },
        *message);
    return out;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, inspected);
}

/// A header is a sure sign; a whole image may be longer than what is looked at.
bool recognise(wire::ByteView bytes) {
    for (; bytes.size() >= header_bytes; bytes = bytes.subspan(1))
        if (bytes[0] == 0xEF && plausible_header(bytes)) return true;
    return false;
}

std::vector<wire::Table> tables() {
    using wire::table_of;
    return {table_of<Header>(), table_of<Bathymetry>(), table_of<Point>(), table_of<WaterColumn>()};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    return inspect::rewritten_frame<Framer>(bytes, [](const Frame& frame) -> wire::Bytes {
        const auto message = parse(frame);
        return message ? encode(*message, frame.header.version, frame.header.type) : wire::Bytes{};
    });
}

std::vector<ChecksumPlace> checksums(wire::ByteView bytes) {
    constexpr std::size_t sum_at = 20, sum_bytes = 4;
    std::vector<ChecksumPlace> places;
    std::size_t at = 0;
    while (const auto header = plausible_header(bytes.subspan(at))) {
        if (header->size > bytes.size() - at || header->size < header_bytes) break;
        const bool has_one = header->type == Type::bathymetry || header->type == Type::water_column;
        if (has_one) places.push_back({at + sum_at, sum_bytes});
        at += header->size;
    }
    return places;
}

}  // namespace echoloop::norbit
