#include "protocols/wire/read.h"

namespace echoloop::wire {

bool read_hex4(const std::uint8_t* from, std::uint64_t& value) {
    value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::uint8_t c = from[i];
        const bool digit = c >= '0' && c <= '9';
        if (!digit && (c < 'A' || c > 'F')) return false;
        value = value * 16 + (digit ? c - '0' : c - 'A' + 10U);
    }
    return true;
}

bool starts_with(const Reader& reader, std::string_view characters) {
    return reader.left() >= characters.size() &&
           std::equal(characters.begin(), characters.end(), reader.here());
}

bool enter_section(Reader& reader, std::size_t& outer, std::string_view name) {
    constexpr std::size_t header = 4;
    if (reader.left() < header) return reader.fail(Reason::truncated, name, "size");
    const std::size_t size = load<ByteOrder::big, std::uint16_t>(reader.here() + 2);
    if (size < header || size % 4 != 0) return reader.fail(Reason::wrong_size, name, "size");
    if (size > reader.left()) return reader.fail(Reason::truncated, name, "size");
    outer = std::exchange(reader.end, reader.position + size);
    reader.position += header;
    return true;
}

bool leave_section(Reader& reader, std::size_t outer, std::string_view name) {
    if (reader.left() >= 4) return reader.fail(Reason::trailing_bytes, name, "");
    for (; reader.left() > 0; ++reader.position) {
        if (*reader.here() != 0) return reader.fail(Reason::wrong_constant, name, "padding");
    }
    reader.end = outer;
    return true;
}

bool tag_here(const Reader& reader, std::string_view tag) {
    if (!starts_with(reader, tag.substr(0, 3)) || reader.left() < 4) return false;
    return tagged_words(static_cast<char>(reader.here()[3])) == tagged_words(tag[3]);
}

}  // namespace echoloop::wire
