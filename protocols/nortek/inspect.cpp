#include "protocols/nortek/inspect.h"

#include "protocols/inspect_stream.h"
#include "protocols/nortek/codec.h"
#include "protocols/nortek/layouts.h"
#include "protocols/wire/read.h"

namespace echoloop::nortek {
namespace {

std::string name_of(const Frame& frame) {
    if (std::holds_alternative<Track>(frame.data))
        return frame.id == bottom_track_id ? "BottomTrack" : "WaterTrack";
    return std::visit([]<class M>(const M&) { return std::string(wire::layout<M>.name); }, frame.data);
}

inspect::Message told_of(const Piece& piece, std::size_t offset, std::size_t size) {
    inspect::Message out{.offset = offset, .size = size};
    if (piece.kind == Piece::Kind::line) {
        out.name = "Line";
        out.fields.push_back({.name = "text",
                              .text = {piece.bytes.begin(), piece.bytes.end()},
                              .offset = offset,
                              .size = piece.bytes.size()});
        return out;
    }
    const auto frame = parse(piece.bytes);
    if (!frame) {
        out.name = "Frame";
        out.reason = frame.error().what();
        return out;
    }
    out.name = name_of(*frame);
    const auto header = wire::parse<Header>(wire::ByteView(piece.bytes).first(header_size));
    if (header) inspect::add_fields(out, *header);
    std::visit(
        [&](const auto& data) {
            wire::visit_fields(data, [&](const wire::FieldView& view) {
                out.fields.push_back(inspect::to_field(view, offset + header_size));
            });
        },
        frame->data);
    return out;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, told_of);
}

/// Anybody says lines.
bool recognise(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    framer.finish();
    while (const auto piece = framer.next())
        if (piece->kind == Piece::Kind::frame) return true;
    return false;
}

std::vector<wire::Table> tables() {
    return {wire::table_of<Header>(), wire::table_of<Track>(), wire::table_of<Altimeter>(),
            wire::table_of<Ahrs>(),   wire::table_of<Imu>(),   wire::table_of<Other>()};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    return inspect::rewritten_frame<Framer>(bytes, [](const Piece& piece) -> wire::Bytes {
        if (piece.kind == Piece::Kind::frame) {
            const auto frame = parse(piece.bytes);
            return frame ? encode(*frame) : wire::Bytes{};
        }
        wire::Bytes line = piece.bytes;
        line.insert(line.end(), piece.line_end.begin(), piece.line_end.end());
        return line;
    });
}

std::vector<ChecksumPlace> checksums(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    std::vector<ChecksumPlace> places;
    while (const auto piece = framer.next())
        if (piece->kind == Piece::Kind::frame) places.push_back({framer.frame_offset() + 6, 2, false});
    return places;
}

}  // namespace echoloop::nortek
