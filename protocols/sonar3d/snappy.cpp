#include "protocols/sonar3d/snappy.h"

#include <algorithm>
#include <array>

#include "protocols/sonar3d/words.h"
#include "protocols/wire/protobuf.h"

namespace echoloop::sonar3d {
namespace {

enum Element : std::uint8_t { literal = 0, near_copy = 1, copy = 2, far_copy = 3 };

constexpr std::size_t hash_bits = 14, reach = 65535, shortest_match = 4, longest_copy = 64;
constexpr std::size_t longest_short_literal = 60;

void put_literal(wire::ByteView bytes, wire::Bytes& out) {
    if (bytes.empty()) return;
    const std::size_t last = bytes.size() - 1;
    if (last < longest_short_literal) {
        out.push_back(static_cast<std::uint8_t>(last << 2 | literal));
    } else {
        const unsigned wide = last < 1U << 8 ? 1 : last < 1U << 16 ? 2 : 3;
        out.push_back(static_cast<std::uint8_t>((longest_short_literal - 1 + wide) << 2 | literal));
        for (unsigned i = 0; i < wide; ++i) out.push_back(static_cast<std::uint8_t>(last >> 8 * i));
    }
    out.insert(out.end(), bytes.begin(), bytes.end());
}

void put_copy(std::size_t offset, std::size_t length, wire::Bytes& out) {
    for (std::size_t part; length > 0; length -= part) {
        part = std::min(length, longest_copy);
        out.push_back(static_cast<std::uint8_t>((part - 1) << 2 | copy));
        out.push_back(static_cast<std::uint8_t>(offset));
        out.push_back(static_cast<std::uint8_t>(offset >> 8));
    }
}

std::size_t match_length(wire::ByteView bytes, std::size_t earlier, std::size_t at) {
    std::size_t length = shortest_match;
    while (at + length < bytes.size() && bytes[earlier + length] == bytes[at + length]) ++length;
    return length;
}

/// Appends `length` bytes that stand `offset` back; they may overlap.
bool repeat(std::size_t offset, std::size_t length, std::size_t size, wire::Bytes& out) {
    if (offset == 0 || offset > out.size() || length > size - out.size()) return false;
    for (std::size_t i = 0; i < length; ++i) out.push_back(out[out.size() - offset]);
    return true;
}

std::size_t little_number(wire::ByteView bytes) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) value |= std::size_t{bytes[i]} << 8 * i;
    return value;
}

bool read_literal(wire::protobuf::Cursor& from, std::uint8_t tag, std::size_t size, wire::Bytes& out) {
    std::size_t last = tag >> 2;
    if (last >= longest_short_literal) last = little_number(from.take(last - longest_short_literal + 1));
    const wire::ByteView bytes = from.take(last + 1);
    if (!from.fine || bytes.size() > size - out.size()) return false;
    out.insert(out.end(), bytes.begin(), bytes.end());
    return true;
}

bool read_element(wire::protobuf::Cursor& from, std::size_t size, wire::Bytes& out) {
    const std::uint8_t tag = from.take(1)[0];
    if ((tag & 3) == literal) return read_literal(from, tag, size, out);
    const bool near = (tag & 3) == near_copy;
    const wire::ByteView low = from.take((tag & 3) == far_copy ? 4 : near ? 1 : 2);
    if (!from.fine) return false;
    const std::size_t length = near ? (tag >> 2 & 7) + 4U : (tag >> 2) + 1U;
    return repeat(little_number(low) | (near ? std::size_t{tag & 0xE0U} << 3 : 0), length, size, out);
}

}  // namespace

wire::Bytes snappy_compress(wire::ByteView bytes) {
    wire::Bytes out;
    wire::protobuf::put_varint(bytes.size(), out);
    std::array<std::uint32_t, std::size_t{1} << hash_bits> seen{};  // position + 1; 0: none
    std::size_t written = 0;
    for (std::size_t at = 0; at + shortest_match <= bytes.size();) {
        const std::uint32_t word = word_at(bytes, at);
        auto& slot = seen[word * 0x9E3779B1U >> (32 - hash_bits)];
        const std::size_t earlier = std::size_t{slot} - 1;
        const bool match = slot != 0 && at - earlier <= reach && word_at(bytes, earlier) == word;
        slot = static_cast<std::uint32_t>(at + 1);
        if (!match) {
            ++at;
            continue;
        }
        const std::size_t length = match_length(bytes, earlier, at);
        put_literal(bytes.subspan(written, at - written), out);
        put_copy(at - earlier, length, out);
        written = at += length;
    }
    put_literal(bytes.subspan(written), out);
    return out;
}

std::optional<wire::Bytes> snappy_uncompress(wire::ByteView block) {
    wire::protobuf::Cursor from{block};
    const std::uint64_t size = from.varint();
    if (!from.fine || size > longest_block) return std::nullopt;
    wire::Bytes out;
    while (from.at < block.size())
        if (!read_element(from, size, out)) return std::nullopt;
    if (out.size() != size) return std::nullopt;
    return out;
}

}  // namespace echoloop::sonar3d
