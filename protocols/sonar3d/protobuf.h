// Protobuf's wire format for structs that have a table of Fields: zero fields are not written, unknown ones
// are skipped, the last of several counts. Never allocates more than the bytes at hand can fill.
#pragma once

#include <bit>
#include <optional>

#include "protocols/sonar3d/layouts.h"

namespace echoloop::sonar3d::protobuf {

inline void put_varint(std::uint64_t value, wire::Bytes& out) {
    for (; value >= 0x80; value >>= 7) out.push_back(static_cast<std::uint8_t>(value | 0x80));
    out.push_back(static_cast<std::uint8_t>(value));
}

/// Reads fields one after another; `fine` turns false, for good, at the first byte that cannot be.
struct Cursor {
    wire::ByteView bytes;
    std::size_t at = 0;
    bool fine = true;

    std::uint64_t varint() {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 64 && at < bytes.size(); shift += 7) {
            const std::uint8_t byte = bytes[at++];
            value |= std::uint64_t{byte & 0x7FU} << shift;
            if (byte < 0x80) return value;
        }
        fine = false;
        return 0;
    }
    wire::ByteView take(std::uint64_t count) {
        if (count > bytes.size() - at) fine = false;
        if (!fine) return {};
        at += count;
        return bytes.subspan(at - count, count);
    }
    wire::ByteView block() { return take(varint()); }
};

enum WireType : std::uint32_t { varint = 0, fixed64 = 1, block = 2, fixed32 = 5 };

inline bool skip(Cursor& from, std::uint32_t type) {
    if (type == varint)
        from.varint();
    else if (type == block)
        from.block();
    else if (type == fixed32 || type == fixed64)
        from.take(type == fixed32 ? 4 : 8);
    else
        from.fine = false;  // groups are no part of proto3
    return from.fine;
}

template <class M>
wire::Bytes write(const M& message);
template <class M>
bool read(wire::ByteView bytes, M& message);

inline void put_key(std::uint32_t number, WireType type, wire::Bytes& out) {
    put_varint(std::uint64_t{number} << 3 | type, out);
}

template <class Chars>
void put_block(std::uint32_t number, const Chars& bytes, wire::Bytes& out) {
    put_key(number, block, out);
    put_varint(bytes.size(), out);
    out.insert(out.end(), bytes.begin(), bytes.end());
}

template <class T>
void put_field(std::uint32_t number, const T& value, wire::Bytes& out) {
    if constexpr (std::is_same_v<T, float>) {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        if (bits == 0) return;
        put_key(number, fixed32, out);
        out.resize(out.size() + 4);
        wire::store<wire::ByteOrder::little>(bits, &*out.end() - 4);
    } else if constexpr (std::is_integral_v<T>) {
        if (value == 0) return;
        put_key(number, varint, out);
        put_varint(static_cast<std::uint64_t>(std::int64_t{value}), out);  // negative: ten bytes
    } else if constexpr (std::is_same_v<T, std::vector<std::uint32_t>>) {
        if (value.empty()) return;
        wire::Bytes packed;
        packed.reserve(3 * value.size());
        for (const std::uint32_t one : value) put_varint(one, packed);
        put_block(number, packed, out);
    } else if constexpr (requires { value.begin(); }) {
        if (!value.empty()) put_block(number, value, out);
    } else {
        put_block(number, write(value), out);
    }
}

inline bool read_packed(wire::ByteView bytes, std::vector<std::uint32_t>& out) {
    Cursor from{bytes};
    out.reserve(out.size() + bytes.size() / 2);
    while (from.fine && from.at < bytes.size()) out.push_back(static_cast<std::uint32_t>(from.varint()));
    return from.fine;
}

/// False if the field is not of type `type`; then nothing has been read.
template <class T>
bool read_field(Cursor& from, std::uint32_t type, T& value) {
    if constexpr (std::is_same_v<T, float>) {
        if (type != fixed32) return false;
        const wire::ByteView bits = from.take(4);
        if (from.fine) value = wire::load<wire::ByteOrder::little, float>(bits.data());
    } else if constexpr (std::is_integral_v<T>) {
        if (type != varint) return false;
        value = static_cast<T>(from.varint());
    } else if constexpr (std::is_same_v<T, std::vector<std::uint32_t>>) {
        if (type == varint)
            value.push_back(static_cast<std::uint32_t>(from.varint()));
        else if (type == block)
            from.fine = read_packed(from.block(), value) && from.fine;
        else
            return false;
    } else if constexpr (requires { value.begin(); }) {
        if (type != block) return false;
        const wire::ByteView bytes = from.block();
        value.assign(bytes.begin(), bytes.end());
    } else {
        if (type != block) return false;
        const wire::ByteView bytes = from.block();
        from.fine = from.fine && read(bytes, value);
    }
    return true;
}

template <class M>
wire::Bytes write(const M& message) {
    wire::Bytes out;
    std::apply([&](const auto&... row) { (put_field(row.number, message.*row.member, out), ...); },
               Fields<M>::rows);
    return out;
}

/// False at bytes that are no protobuf message.
template <class M>
bool read(wire::ByteView bytes, M& message) {
    Cursor from{bytes};
    while (from.fine && from.at < bytes.size()) {
        const std::uint64_t key = from.varint();
        const auto type = static_cast<std::uint32_t>(key & 7);
        const auto take = [&](const auto& row) {
            return key >> 3 == row.number && read_field(from, type, message.*row.member);
        };
        if (!from.fine || key >> 3 == 0) return false;
        if (!std::apply([&](const auto&... row) { return (take(row) || ...); }, Fields<M>::rows))
            skip(from, type);
    }
    return from.fine;
}

}  // namespace echoloop::sonar3d::protobuf
