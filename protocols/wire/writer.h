// The bytes of a message as they grow, and how each plain kind of field is written. Never writes sections or
// lists: write_sections.h does.
#pragma once

#include <algorithm>

#include "protocols/wire/collect.h"
#include "protocols/wire/layout.h"

namespace echoloop::wire {

struct Writer {
    Bytes out;
    CountCollector counts{};
    std::size_t size_at = 0;  ///< of the field that holds the size of the whole message
    void (*set_size)(Bytes&, std::size_t) = nullptr;  ///< writes it there

    /// Room for `size` more bytes, zeroed.
    std::uint8_t* grow(std::size_t size) {
        out.resize(out.size() + size);
        return out.data() + out.size() - size;
    }
};

template <class M>
void write_fields(Writer& writer, const M& message);

template <ByteOrder Order, class T>
void write_value(Writer& writer, const T& value) {
    if constexpr (HasLayout<T>) {
        write_fields(writer, value);
    } else if constexpr (Scalar<T>) {
        store<Order>(value, writer.grow(sizeof(T)));
    } else if constexpr (is_text<T>) {
        store_array<Order>(std::span<const char>(value.chars), writer.grow(value.chars.size()));
    } else {
        using Item = typename T::value_type;
        store_array<Order>(std::span<const Item>(value), writer.grow(*fixed_size<T>()));
    }
}

/// Exactly `elements` values: the vector cut, or filled up with zeros.
template <ByteOrder Order, class V>
void write_elements(Writer& writer, const V& vector, std::size_t elements) {
    using T = typename V::value_type;
    const std::size_t given = std::min(elements, vector.size());
    if constexpr (Scalar<T>) {
        store_array<Order>(std::span<const T>(vector.data(), given), writer.grow(elements * sizeof(T)));
    } else {
        for (std::size_t i = 0; i < given; ++i) write_fields(writer, vector[i]);
        writer.grow((elements - given) * *fixed_size<T>());
    }
}

template <class M, class T>
void write_field(Writer& writer, const M& message, const Member<M, T>& field) {
    write_value<layout<M>.order>(writer, message.*field.member);
}

void write_hex4(std::uint64_t value, std::uint8_t* to);

template <class M, class Wire>
void write_field(Writer& writer, const M&, const Count<Wire>& field) {
    const std::uint64_t raw = writer.counts.get(field.key) + static_cast<std::uint64_t>(field.bias);
    if constexpr (std::is_same_v<Wire, HexDigits4>) {
        write_hex4(raw, writer.grow(4));
    } else {
        write_value<layout<M>.order>(writer, static_cast<Wire>(raw));
    }
}

template <class M, class T>
void write_field(Writer& writer, const M&, const CountMember<M, T>& field) {
    write_value<layout<M>.order>(writer, static_cast<T>(writer.counts.get(field.key)));
}

template <class M, class V>
void write_field(Writer& writer, const M& message, const Counted<M, V>& field) {
    const auto elements = static_cast<std::size_t>(writer.counts.elements(field.count));
    write_elements<layout<M>.order>(writer, message.*field.member, elements);
}

template <class M, class T>
void write_field(Writer& writer, const M&, const Constant<T>& field) {
    write_value<layout<M>.order>(writer, field.value);
}

template <class M>
void write_field(Writer& writer, const M&, const Magic& field) {
    std::copy(field.value.begin(), field.value.end(), writer.grow(field.value.size()));
}

/// Set by serialise() when the size is known.
template <class M, class T>
void write_field(Writer& writer, const M&, const TotalSize<T>&) {
    writer.size_at = writer.out.size();
    writer.set_size = [](Bytes& out, std::size_t at) {
        store<layout<M>.order>(static_cast<T>(out.size()), out.data() + at);
    };
    writer.grow(sizeof(T));
}

/// Cut or filled up with zeros to the usual size, unless its own size is legal.
template <class M>
void write_field(Writer& writer, const M& message, const Rest<M>& field) {
    const auto& bytes = message.*field.member;
    write_elements<layout<M>.order>(writer, bytes,
                                    field.is_legal(bytes.size()) ? bytes.size() : field.sizes[0]);
}

}  // namespace echoloop::wire
