// Protobuf for structs that have a table of their fields: fields that are 0 are not written, unknown ones are
// skipped, of a field that comes twice the last counts. Never allocates more than the bytes at hand can fill.
#pragma once

#include <string>
#include <string_view>
#include <tuple>

#include "protocols/wire/layout.h"

namespace echoloop::wire::protobuf {

/// One field of a message; the member's type gives the wire type. Numbers, strings, bytes, packed arrays of
/// u32, lists of strings, messages; a message that may be absent is a std::optional.
template <class M, class T>
struct Field {
    std::uint32_t number;
    T M::*member;
    std::string_view name, unit, help;
    bool always = false;  ///< written even when 0, for readers that test presence
};
template <class M, class T>
Field(std::uint32_t, T M::*, std::string_view, std::string_view, std::string_view, bool = false)
    -> Field<M, T>;

template <class... Fields>
struct Layout {
    std::string_view name, help;
    std::tuple<Fields...> fields;
};
template <class... Fields>
constexpr Layout<Fields...> make_message(std::string_view name, std::string_view help, Fields... fields) {
    return {name, help, {fields...}};
}

/// The table of M: what `protobuf_layout(Tag<M>)` returns, a constexpr function beside M.
template <class M>
inline constexpr auto layout = protobuf_layout(Tag<M>{});

/// Calls `visit` with each field of M.
template <class M, class Visit>
void for_each_field(const Visit& visit) {
    std::apply([&](const auto&... field) { (visit(field), ...); }, layout<M>.fields);
}

enum WireType : std::uint32_t { varint = 0, fixed64 = 1, block = 2, fixed32 = 5 };

template <class T>
inline constexpr bool is_packed = std::is_same_v<T, std::vector<std::uint32_t>>;
template <class T>
inline constexpr bool is_list = std::is_same_v<T, std::vector<std::string>>;
template <class T>
inline constexpr bool is_message = requires {
    protobuf_layout(Tag<T>{});
};

template <class T>
constexpr WireType wire_type() {
    if constexpr (std::is_same_v<T, float>) return fixed32;
    return std::is_integral_v<T> ? varint : block;
}

/// Reads one thing after another; `fine` turns false, for good, at the first that cannot be.
struct Cursor {
    ByteView bytes;
    std::size_t at = 0;
    bool fine = true;

    bool more() const { return fine && at < bytes.size(); }
    /// 64 bits; ten bytes at most.
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
    ByteView take(std::uint64_t count);
    ByteView block() { return take(varint()); }
    void skip(std::uint32_t type);
};

void put_varint(std::uint64_t value, Bytes& out);
void put_float(float value, Bytes& out);
/// Behind its size.
void put_block(ByteView bytes, Bytes& out);

template <class M>
void write(const M& message, Bytes& out);
/// False at bytes that are no message, or a part of which is none.
template <class M>
bool read(ByteView bytes, M& message);

/// A float that is plus zero is absent; minus zero and NaN are not.
template <class T>
bool is_absent(const T& value) {
    if constexpr (std::is_same_v<T, float>)
        return std::bit_cast<std::uint32_t>(value) == 0;
    else if constexpr (std::is_integral_v<T>)
        return value == 0;
    else if constexpr (is_optional<T>)
        return !value;
    else if constexpr (is_message<T>)
        return false;
    else
        return value.empty();
}

template <class T>
void write_value(const T& value, Bytes& out) {
    if constexpr (std::is_same_v<T, float>) {
        put_float(value, out);
    } else if constexpr (std::is_integral_v<T>) {
        put_varint(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)), out);  // negative: ten bytes
    } else if constexpr (is_optional<T>) {
        write_value(*value, out);
    } else if constexpr (std::is_same_v<T, std::string>) {
        put_block({reinterpret_cast<const std::uint8_t*>(value.data()), value.size()}, out);
    } else if constexpr (std::is_same_v<T, Bytes>) {
        put_block(value, out);
    } else {
        Bytes part;
        if constexpr (is_packed<T>) {
            part.reserve(3 * value.size());
            for (const std::uint32_t one : value) put_varint(one, part);
        } else {
            write(value, part);
        }
        put_block(part, out);
    }
}

template <class M, class T>
void write_field(const M& message, const Field<M, T>& field, Bytes& out) {
    const T& value = message.*field.member;
    if (is_absent(value) && !field.always) return;
    const auto write_one = [&](const auto& one) {
        put_varint(std::uint64_t{field.number} << 3 | wire_type<T>(), out);
        write_value(one, out);
    };
    if constexpr (is_list<T>)
        for (const std::string& one : value) write_one(one);
    else
        write_one(value);
}

template <class M>
void write(const M& message, Bytes& out) {
    for_each_field<M>([&](const auto& field) { write_field(message, field, out); });
}

template <class M>
Bytes write(const M& message) {
    Bytes out;
    write(message, out);
    return out;
}

template <class T>
void read_value(Cursor& from, T& value) {
    if constexpr (std::is_same_v<T, float>) {
        const ByteView bits = from.take(4);
        if (from.fine) value = load<ByteOrder::little, float>(bits.data());
    } else if constexpr (std::is_same_v<T, bool>) {
        value = from.varint() != 0;
    } else if constexpr (std::is_integral_v<T>) {
        value = static_cast<T>(from.varint());
    } else if constexpr (is_optional<T>) {
        read_value(from, value.emplace());
    } else if constexpr (is_message<T>) {
        const ByteView part = from.block();
        from.fine = from.fine && read(part, value);
    } else if constexpr (is_packed<T>) {
        Cursor packed{from.block()};
        value.reserve(value.size() + packed.bytes.size() / 2);
        while (packed.more()) value.push_back(static_cast<std::uint32_t>(packed.varint()));
        from.fine = from.fine && packed.fine;
    } else if constexpr (is_list<T>) {
        const ByteView text = from.block();
        value.emplace_back(text.begin(), text.end());
    } else {
        const ByteView bytes = from.block();
        value.assign(bytes.begin(), bytes.end());
    }
}

/// False if the field is not of type `type`; then nothing has been read.
template <class T>
bool read_field(Cursor& from, std::uint32_t type, T& value) {
    if constexpr (is_packed<T>) {
        if (type == varint) {
            value.push_back(static_cast<std::uint32_t>(from.varint()));
            return true;
        }
    }
    if (type != wire_type<T>()) return false;
    read_value(from, value);
    return true;
}

template <class M>
bool read(ByteView bytes, M& message) {
    Cursor from{bytes};
    while (from.more()) {
        const std::uint64_t key = from.varint();
        const auto type = static_cast<std::uint32_t>(key & 7);
        const auto take = [&](const auto& field) {
            return key >> 3 == field.number && read_field(from, type, message.*field.member);
        };
        if (!from.fine || key >> 3 == 0) return false;
        if (!std::apply([&](const auto&... field) { return (take(field) || ...); }, layout<M>.fields))
            from.skip(type);
    }
    return from.fine;
}

}  // namespace echoloop::wire::protobuf
