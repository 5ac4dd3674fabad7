#include "protocols/waterlinked/inspect.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "protocols/inspect_stream.h"
#include "protocols/waterlinked/fields.h"
#include "protocols/waterlinked/framer.h"
#include "protocols/waterlinked/json_text.h"
#include "protocols/waterlinked/pd4.h"
#include "protocols/waterlinked/sentence.h"

namespace echoloop::waterlinked {
namespace {

using inspect::Field;
using inspect::Message;
using Kind = Piece::Kind;

std::optional<double> number_in(std::string_view text) {
    while (text.starts_with(' ')) text.remove_prefix(1);
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool plain = text.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
    if (text.empty() || !plain || error != std::errc() || stop != end) return std::nullopt;
    return value;
}

/// The field at `place` of a known message, or one without a name.
Field field_at(const MessageRow* row, std::size_t place, std::string_view text, std::size_t offset) {
    Field field{.text = std::string(text), .offset = offset, .size = text.size()};
    if (row == nullptr || place >= row->fields.size()) {
        field.name = "field" + std::to_string(place + 1);
        return field;
    }
    const FieldRow& known = row->fields[place];
    field.name = known.name;
    if (!known.number) return field;
    field.number = number_in(text);
    if (field.number) field.unit = known.unit;
    return field;
}

void add_list(Message& out, const MessageRow* row, const std::vector<std::string>& fields, std::size_t at) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
        out.fields.push_back(field_at(row, i, fields[i], at));
        at += fields[i].size() + 1;
    }
}

const std::string_view commands = "command", responses = "response";

/// Which of json_messages() it is; "object" if none.
std::string name_of(const std::vector<Member>& members) {
    const std::string_view type = unquoted(value_of(members, "type"));
    if (find_row(json_messages(), type) != nullptr && type != commands) return std::string(type);
    if (!value_of(members, "command").empty()) return std::string(commands);
    return value_of(members, "response_to").empty() ? "object" : std::string(responses);
}

void add_json(Message& out, const std::string& text) {
    const auto members = members_of(text);
    out.name = members ? name_of(*members) : "object";
    if (!members) {
        out.reason = text.starts_with('[') ? "object at byte 0: an array, not an object"
                                           : "object at byte 0: not JSON";
        return;
    }
    const MessageRow* row = find_row(json_messages(), out.name);
    for (const Member& member : *members) {
        const auto at = static_cast<std::size_t>(member.value.data() - text.data());
        const auto rows = row != nullptr ? row->fields : std::span<const FieldRow>{};
        const auto known = std::ranges::find(rows, member.key, &FieldRow::name);
        const auto place = static_cast<std::size_t>(known - rows.begin());
        Field field = field_at(row, place, unquoted(member.value), out.offset + at);
        if (known == rows.end()) field.name = member.key;
        field.size = member.value.size();
        out.fields.push_back(std::move(field));
    }
}

void add_sentence(Message& out, const std::string& text) {
    const auto sentence = read_sentence(text);
    if (!sentence) {
        out.name = "sentence";
        out.reason = "sentence at byte 0: not one";
        return;
    }
    out.name = sentence->address;
    add_list(out, find_row(sentences(), sentence->address), sentence->fields, out.offset + 4);
    if (!sentence->checksum) return;
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", unsigned{*sentence->checksum});
    out.fields.push_back(
        {.name = "checksum", .text = digits, .offset = out.offset + text.size() - 2, .size = 2});
    if (sentence->checksum_fits()) return;
    std::snprintf(digits, sizeof digits, "%02x", unsigned{crc8(sentence->body())});
    out.reason =
        out.name + ".checksum at byte " + std::to_string(text.size() - 2) + ": the characters make " + digits;
}

wire::ByteView bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

void add_pd4(Message& out, const std::string& text) {
    out.name = "PD4";
    const auto block = parse_pd4(bytes_of(text));
    if (block)
        inspect::add_fields(out, *block);
    else
        out.reason = block.error().what();
}

Message inspected(const Piece& piece, std::size_t offset, std::size_t size) {
    Message out{.offset = offset, .size = size};
    switch (piece.kind) {
        case Kind::json:
            add_json(out, piece.text);
            break;
        case Kind::sentence:
            add_sentence(out, piece.text);
            break;
        case Kind::pd6:
            add_pd6(out, piece.text);
            break;
        case Kind::pd4:
            add_pd4(out, piece.text);
            break;
    }
    return out;
}

bool is_sure(const Piece& piece) {
    if (piece.kind == Kind::pd4) return parse_pd4(bytes_of(piece.text)).has_value();
    if (piece.kind == Kind::pd6) return is_pd6(piece.text);
    if (piece.kind == Kind::sentence) {
        const auto sentence = read_sentence(piece.text);
        return sentence && sentence->checksum && sentence->checksum_fits();
    }
    const auto members = members_of(piece.text);
    return members && name_of(*members) != "object";
}

wire::Table table_of(const MessageRow& row) {
    wire::Table table{.name = std::string(row.name), .help = std::string(row.help)};
    for (const FieldRow& field : row.fields)
        table.rows.push_back(
            {.meta = {field.name, field.unit, field.help}, .type = field.number ? "number" : "char[]"});
    return table;
}

wire::Bytes plain(const std::string& text) { return {text.begin(), text.end()}; }

std::string rewritten_json(const std::string& text) {
    const auto members = members_of(text);
    if (!members) return "";
    std::string out = "{";
    for (const Member& member : *members) {
        if (out.size() > 1) out += ',';
        out.append(1, '"').append(member.key).append("\":").append(member.value);
    }
    return out + '}';
}

wire::Bytes rewritten_piece(const Piece& piece) {
    if (piece.kind == Kind::pd4) {
        const auto block = parse_pd4(bytes_of(piece.text));
        return block ? encode(*block) : wire::Bytes{};
    }
    if (piece.kind == Kind::json) {
        const std::string text = rewritten_json(piece.text);
        return text.empty() ? wire::Bytes{} : plain(text + piece.line_end);
    }
    if (piece.kind == Kind::pd6) return plain(piece.text + piece.line_end);
    const auto sentence = read_sentence(piece.text);
    return sentence ? plain(write_sentence(*sentence)) : wire::Bytes{};
}

}  // namespace

bool is_pd6(std::string_view line) {
    const bool begins = line.size() > 3 && line[0] == ':' && line[3] == ',';
    return begins && find_row(pd6_lines(), line.substr(1, 2)) != nullptr;
}

/// Numbers are written with blanks before them.
void add_pd6(Message& out, std::string_view text) {
    std::size_t at = 4;  // behind ":BI,"
    out.name = text.substr(1, 2);
    for (std::size_t place = 0; at <= text.size(); ++place) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        const std::size_t begin = std::min(text.find_first_not_of(' ', at), end);
        const auto word = text.substr(begin, end - begin);
        out.fields.push_back(field_at(find_row(pd6_lines(), out.name), place, word, out.offset + begin));
        at = end + 1;
    }
}

std::vector<wire::Table> pd6_tables() {
    std::vector<wire::Table> all;
    for (const MessageRow& row : pd6_lines()) all.push_back(table_of(row));
    return all;
}

std::vector<Message> decode(wire::ByteView bytes) { return inspect::decode_stream<Framer>(bytes, inspected); }

bool recognise(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    framer.finish();
    while (const auto piece = framer.next())
        if (is_sure(*piece)) return true;
    return false;
}

std::vector<wire::Table> tables() {
    std::vector<wire::Table> all;
    for (const auto rows : {json_messages(), sentences(), pd6_lines()})
        for (const MessageRow& row : rows) all.push_back(table_of(row));
    all.push_back(wire::table_of<Pd4>());
    return all;
}

wire::Bytes rewritten(wire::ByteView bytes) {
    return inspect::rewritten_frame<Framer>(bytes, rewritten_piece);
}

std::vector<ChecksumPlace> checksums(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    std::vector<ChecksumPlace> places;
    while (const auto piece = framer.next()) {
        const std::size_t end = framer.frame_offset() + piece->text.size();
        if (piece->kind == Kind::pd4) places.push_back({end - 2, 2, false});
        if (piece->kind == Kind::sentence && piece->text.size() > 3 &&
            piece->text[piece->text.size() - 3] == '*')
            places.push_back({end - 2, 2, true});
    }
    return places;
}

}  // namespace echoloop::waterlinked
