#include "protocols/nortek/inspect.h"

#include <algorithm>
#include <charconv>

#include "protocols/inspect_stream.h"
#include "protocols/nmea/sentences.h"
#include "protocols/nortek/codec.h"
#include "protocols/nortek/layouts.h"
#include "protocols/nortek/sentences.h"
#include "protocols/wire/read.h"

namespace echoloop::nortek {
namespace {

std::string name_of(const Frame& frame) {
    if (std::holds_alternative<Track>(frame.data))
        return frame.id == bottom_track_id ? "BottomTrack" : "WaterTrack";
    if (std::holds_alternative<DvlTrack>(frame.data))
        return frame.id == dvl_bottom_track_id ? "DvlBottomTrack" : "DvlWaterTrack";
    return std::visit([]<class M>(const M&) { return std::string(wire::layout<M>.name); }, frame.data);
}

std::string_view text_of(const Piece& piece) {
    return {reinterpret_cast<const char*>(piece.bytes.data()), piece.bytes.size()};
}

/// A line "$address,values*hh" in its parts; of others the address is empty.
struct Line {
    std::string_view address, values, sum;
    bool fits = false;
};
Line parts_of(std::string_view text) {
    const std::size_t star = text.rfind('*'), comma = text.find(',');
    if (!text.starts_with('$') || star == std::string_view::npos || star + 3 != text.size() || comma > star)
        return {};
    Line out{text.substr(1, comma - 1), text.substr(comma + 1, star - comma - 1), text.substr(star + 1)};
    unsigned said = 0;
    const auto [end, error] = std::from_chars(out.sum.data(), out.sum.data() + 2, said, 16);
    out.fits =
        error == std::errc() && end == out.sum.data() + 2 && said == nmea::checksum(text.substr(1, star - 1));
    return out;
}

std::string fault(std::string_view address, std::string_view field, std::size_t at, const char* what) {
    return std::string(address) + '.' + std::string(field) + " at byte " + std::to_string(at) + ": " + what;
}

/// The value of one field, behind its tag if there is one.
void add_value(inspect::Message& out, const LineField& row, bool tag, std::string_view word, std::size_t at) {
    const std::string before = std::string(row.tag) + '=';
    if (tag && !word.starts_with(before)) {
        out.reason = fault(out.name, row.name, at, "not its tag");
        return;
    }
    if (tag) word.remove_prefix(before.size()), at += before.size();
    inspect::Field field{.name = std::string(row.name),
                         .text = std::string(word),
                         .offset = out.offset + at,
                         .size = word.size()};
    if (row.decimals >= 0) {
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc() || end != word.data() + word.size()) {
            out.reason = fault(out.name, row.name, at, "not a number");
            return;
        }
        field.number = value;
        field.unit = row.unit;
    }
    out.fields.push_back(std::move(field));
}

/// Of a track; false if it is another line.
bool add_track(inspect::Message& out, std::string_view text) {
    const Line line = parts_of(text);
    const auto kind = line_kind(line.address);
    if (!kind) return false;
    out.name = line.address;
    std::size_t at = 1 + line.address.size() + 1, from = 0;
    for (const LineField& row : kind->form->fields) {
        if (from > line.values.size()) {
            out.reason = fault(out.name, row.name, at + from, "the fields end here");
            break;
        }
        const std::size_t end = std::min(line.values.find(',', from), line.values.size());
        add_value(out, row, kind->tags, line.values.substr(from, end - from), at + from);
        if (!out.reason.empty()) break;
        from = end + 1;
    }
    if (out.reason.empty() && from <= line.values.size())
        out.reason = fault(out.name, "fields", at + from, "more than it has");
    out.fields.push_back({.name = "checksum",
                          .text = std::string(line.sum),
                          .offset = out.offset + text.size() - 2,
                          .size = 2});
    if (!line.fits) out.reason = fault(out.name, "checksum", text.size() - 2, "not that of the characters");
    return true;
}

inspect::Message told_of(const Piece& piece, std::size_t offset, std::size_t size) {
    inspect::Message out{.offset = offset, .size = size};
    if (piece.kind == Piece::Kind::line) {
        if (add_track(out, text_of(piece))) return out;
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

wire::Table table_of(const LineForm& form) {
    wire::Table table{.name = std::string(form.name), .help = std::string(form.help)};
    for (const LineField& field : form.fields)
        table.rows.push_back({.meta = {field.name, field.unit, std::string_view(field.help)},
                              .type = field.decimals < 0 ? "char[]" : "number"});
    return table;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, told_of);
}

/// Anybody says lines, but those of tracks.
bool recognise(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    framer.finish();
    while (const auto piece = framer.next()) {
        if (piece->kind == Piece::Kind::frame) return true;
        const Line line = parts_of(text_of(*piece));
        if (line.fits && line_kind(line.address)) return true;
    }
    return false;
}

std::vector<wire::Table> tables() {
    std::vector<wire::Table> all{wire::table_of<Header>(),    wire::table_of<Track>(),
                                 wire::table_of<Altimeter>(), wire::table_of<Ahrs>(),
                                 wire::table_of<Imu>(),       wire::table_of<DvlTrack>(),
                                 wire::table_of<Other>()};
    for (const LineForm& form : line_forms()) all.push_back(table_of(form));
    return all;
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
        if (piece->kind == Piece::Kind::frame)
            places.push_back({framer.frame_offset() + 6, 2, false});
        else if (const Line line = parts_of(text_of(*piece)); !line.sum.empty())
            places.push_back({framer.frame_offset() + piece->bytes.size() - 2, 2, true});
    return places;
}

}  // namespace echoloop::nortek
