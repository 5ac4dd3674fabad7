// A place in the bytes of a message, and how each plain kind of field is read there. Never reads sections or
// lists: read_sections.h does.
#pragma once

#include <algorithm>
#include <utility>

#include "protocols/wire/counts.h"
#include "protocols/wire/layout.h"
#include "protocols/wire/result.h"

namespace echoloop::wire {

/// A place in the bytes of one message.
struct Reader {
    ByteView bytes;
    std::size_t base = 0;            ///< offset of the first byte as the specification counts
    std::size_t end = bytes.size();  ///< of the message, or of the section that is being read
    std::size_t position = 0;
    Counts counts{};
    Error error{};

    std::size_t left() const { return end - position; }
    const std::uint8_t* here() const { return bytes.data() + position; }
    bool fail(Reason reason, std::string_view message, std::string_view field) {
        error = {message, field, base + position, reason};
        return false;
    }
};

template <class M>
bool read_fields(Reader& reader, M& message);

/// One value of a member's type, in the byte order of the message M around it.
template <class M, class T>
bool read_value(Reader& reader, T& value, std::string_view name) {
    constexpr ByteOrder order = layout<M>.order;
    if constexpr (HasLayout<T>) {
        return read_fields(reader, value);
    } else {
        constexpr std::size_t size = *fixed_size<T>();
        if (reader.left() < size) return reader.fail(Reason::truncated, layout<M>.name, name);
        if constexpr (Scalar<T>) {
            value = load<order, T>(reader.here());
        } else if constexpr (is_text<T>) {
            load_array<order>(reader.here(), std::span<char>(value.chars));
        } else {
            load_array<order>(reader.here(), std::span<typename T::value_type>(value));
        }
        reader.position += size;
        return true;
    }
}

/// `elements` values; checked against the bytes that are left before anything is allocated.
template <class M, class V>
bool read_elements(Reader& reader, V& vector, std::uint64_t elements, std::string_view name) {
    using T = typename V::value_type;
    constexpr std::size_t size = *fixed_size<T>();
    if (elements > reader.left() / size) return reader.fail(Reason::truncated, layout<M>.name, name);
    vector.resize(static_cast<std::size_t>(elements));
    if constexpr (Scalar<T>) {
        load_array<layout<M>.order>(reader.here(), std::span<T>(vector));
        reader.position += vector.size() * size;
        return true;
    } else {
        return std::all_of(vector.begin(), vector.end(), [&](T& item) { return read_fields(reader, item); });
    }
}

template <class M, class T>
bool read_field(Reader& reader, M& message, const Member<M, T>& field) {
    return read_value<M>(reader, message.*field.member, field.meta.name);
}

/// Four ASCII hex digits; false if they are not.
bool read_hex4(const std::uint8_t* from, std::uint64_t& value);

template <class M, class Wire>
bool read_field(Reader& reader, M&, const Count<Wire>& field) {
    const std::size_t size = *field_size(field);
    if (reader.left() < size) return reader.fail(Reason::truncated, layout<M>.name, field.meta.name);
    std::uint64_t raw = 0;
    if constexpr (std::is_same_v<Wire, HexDigits4>) {
        if (!read_hex4(reader.here(), raw)) {
            return reader.fail(Reason::wrong_constant, layout<M>.name, field.meta.name);
        }
    } else {
        raw = load<layout<M>.order, Wire>(reader.here());
    }
    const auto elements = static_cast<std::int64_t>(raw) - field.bias;
    if (elements < 0 || !reader.counts.set(field.key, static_cast<std::uint64_t>(elements))) {
        return reader.fail(Reason::wrong_count, layout<M>.name, field.meta.name);
    }
    reader.position += size;
    return true;
}

template <class M, class T>
bool read_field(Reader& reader, M& message, const CountMember<M, T>& field) {
    T& value = message.*field.member;
    if (!read_value<M>(reader, value, field.meta.name)) return false;
    if (reader.counts.set(field.key, value)) return true;
    reader.position -= sizeof(T);
    return reader.fail(Reason::wrong_count, layout<M>.name, field.meta.name);
}

template <class M, class V>
bool read_field(Reader& reader, M& message, const Counted<M, V>& field) {
    const std::uint64_t elements = reader.counts.elements(field.count);
    return read_elements<M>(reader, message.*field.member, elements, field.meta.name);
}

template <class M, class T>
bool read_field(Reader& reader, M&, const Constant<T>& field) {
    T value{};
    if (!read_value<M>(reader, value, field.meta.name)) return false;
    if (value == field.value) return true;
    reader.position -= sizeof(T);
    return reader.fail(Reason::wrong_constant, layout<M>.name, field.meta.name);
}

/// True if the bytes at the reader start with these characters; moves nothing.
bool starts_with(const Reader& reader, std::string_view characters);

template <class M>
bool read_field(Reader& reader, M&, const Magic& field) {
    const std::size_t size = field.value.size();
    if (reader.left() < size) return reader.fail(Reason::truncated, layout<M>.name, field.meta.name);
    if (!starts_with(reader, field.value)) {
        return reader.fail(Reason::wrong_constant, layout<M>.name, field.meta.name);
    }
    reader.position += size;
    return true;
}

template <class M, class T>
bool read_field(Reader& reader, M&, const TotalSize<T>& field) {
    T value{};
    if (!read_value<M>(reader, value, field.meta.name)) return false;
    if (value == reader.bytes.size()) return true;
    reader.position -= sizeof(T);
    const bool short_of = value > reader.bytes.size();
    return reader.fail(short_of ? Reason::truncated : Reason::trailing_bytes, layout<M>.name,
                       field.meta.name);
}

template <class M>
bool read_field(Reader& reader, M& message, const Rest<M>& field) {
    const std::size_t left = reader.left();
    if (!field.is_legal(left)) return reader.fail(Reason::wrong_size, layout<M>.name, field.meta.name);
    return read_elements<M>(reader, message.*field.member, left, field.meta.name);
}

}  // namespace echoloop::wire
