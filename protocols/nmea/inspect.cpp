#include "protocols/nmea/inspect.h"

#include <array>
#include <cstdio>

#include "protocols/inspect_stream.h"
#include "protocols/nmea/framer.h"
#include "protocols/nmea/sentence.h"
#include "protocols/nmea/sentences.h"

namespace echoloop::nmea {
namespace {

inspect::Field text_field(std::string name, const std::string& text, std::size_t offset) {
    return {.name = std::move(name), .text = text, .unit = "", .offset = offset, .size = text.size()};
}

/// A number with its unit, or "null".
inspect::Field number_field(const FieldRow& row, const std::string& text, std::size_t offset) {
    auto field = text_field(std::string(row.name), text, offset);
    field.number = read_number(text);
    if (text.empty()) {
        field.text = "null";
    } else {
        field.unit = row.unit;
    }
    return field;
}

std::string fault(std::string_view message, std::string_view field, std::size_t offset, const char* what) {
    return std::string(message) + '.' + std::string(field) + " at byte " + std::to_string(offset) + ": " +
           what;
}

/// Why the field at `place` is not what the row says; empty if it is.
std::string check(const SentenceRow& row, const Sentence& sentence, std::size_t place, std::size_t offset) {
    const FieldRow& expected = row.fields[place];
    if (place >= sentence.fields.size())
        return place < row.required ? fault(row.formatter, expected.name, offset, "the fields end here") : "";
    const std::string& text = sentence.fields[place];
    if (expected.letter == any_letters) return {};
    if (expected.letter != 0 && text != std::string(1, expected.letter))
        return fault(row.formatter, expected.name, offset, "not the letter of this unit");
    if (expected.letter == 0 && !text.empty() && !read_number(text))
        return fault(row.formatter, expected.name, offset, "not a number");
    return {};
}

/// The fields of a sentence, those of a known one by name and unit; the first fault is the message's reason.
void add_fields(inspect::Message& out, const Sentence& sentence, const SentenceRow* row) {
    std::size_t at = 1 + sentence.address.size() + 1;  // behind '$', address and comma
    const std::size_t known = row != nullptr ? row->fields.size() : 0;
    for (std::size_t i = 0; i < std::max(sentence.fields.size(), known); ++i) {
        if (i < known && out.reason.empty()) out.reason = check(*row, sentence, i, at);
        if (i >= sentence.fields.size()) break;
        const std::string& text = sentence.fields[i];
        const bool number = i < known && row->fields[i].letter == 0;
        const std::string name =
            i < known ? std::string(row->fields[i].name) : "field" + std::to_string(i + 1);
        out.fields.push_back(number ? number_field(row->fields[i], text, out.offset + at)
                                    : text_field(name, text, out.offset + at));
        at += text.size() + 1;
    }
}

void add_checksum(inspect::Message& out, const Sentence& sentence, std::size_t end) {
    if (!sentence.checksum) return;
    std::array<char, 3> digits{};
    std::snprintf(digits.data(), digits.size(), "%02X", unsigned{*sentence.checksum});
    out.fields.push_back(text_field("checksum", digits.data(), out.offset + end - 2));
    if (sentence.checksum_fits()) return;
    std::snprintf(digits.data(), digits.size(), "%02X", unsigned{checksum(sentence.body())});
    out.reason = fault("Sentence", "checksum", end - 2, "the characters make ") + digits.data();
}

inspect::Message inspected(const Line& line, std::size_t offset, std::size_t size) {
    inspect::Message out{.offset = offset, .size = size};
    const auto sentence = read_sentence(line.text);
    if (!sentence) {
        out.name = "Sentence";
        out.reason = "Sentence.checksum at byte " + std::to_string(line.text.find('*') + 1) +
                     ": not two hex digits at the end";
        return out;
    }
    const SentenceRow* row = find_row(sentence->address);
    out.name = row != nullptr ? std::string(row->formatter) : sentence->address;
    out.fields.push_back(text_field("address", sentence->address, offset + 1));
    add_fields(out, *sentence, row);
    add_checksum(out, *sentence, line.text.size());
    return out;
}

wire::Table table_of_sentence() {
    const auto row = [](std::string_view name, const char* type, std::string_view help) {
        return wire::Row{.meta = {name, "", help}, .type = type};
    };
    return {
        .name = "Sentence",
        .help = "one line of text. Others than those below are shown by their address and field by field",
        .rows = {row("start", "char", "'$', or '!' before encapsulated binary"),
                 row("address", "char[]",
                     "two letters of the talker and three of the formatter, or P and a maker's own"),
                 row("fields", "char[]", "a comma before each; null fields are empty"),
                 row("checksum", "hex[2]", "behind '*': exclusive or of all characters between '$' and '*'"),
                 row("end", "char[2]", "CR LF")}};
}

wire::Table table_of(const SentenceRow& known) {
    wire::Table table{.name = std::string(known.formatter), .help = std::string(known.help)};
    for (const FieldRow& field : known.fields)
        table.rows.push_back(
            {.meta = {field.name, field.unit, field.help}, .type = field.letter == 0 ? "number" : "char"});
    return table;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, inspected);
}

bool recognise(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    framer.finish();
    while (const auto line = framer.next()) {
        const auto sentence = read_sentence(line->text);
        if (sentence && sentence->checksum && sentence->checksum_fits()) return true;
    }
    return false;
}

std::vector<wire::Table> tables() {
    std::vector<wire::Table> all{table_of_sentence()};
    for (const SentenceRow& known : known_sentences()) all.push_back(table_of(known));
    return all;
}

wire::Bytes rewritten(wire::ByteView bytes) {
    return inspect::rewritten_frame<Framer>(bytes, [](const Line& line) -> wire::Bytes {
        const auto sentence = read_sentence(line.text);
        const std::string text = sentence ? write_sentence(*sentence) : "";
        return {text.begin(), text.end()};
    });
}

std::vector<ChecksumPlace> checksums(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    std::vector<ChecksumPlace> places;
    while (const auto line = framer.next()) {
        const std::size_t star = line->text.find('*');
        if (star != std::string::npos && star + 3 == line->text.size())
            places.push_back({framer.frame_offset() + star + 1, 2, true});
    }
    return places;
}

}  // namespace echoloop::nmea
