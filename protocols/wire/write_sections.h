// How sections and lists of structs are written. Include write.h to use it.
#pragma once

#include <cassert>
#include <limits>
#include <variant>

#include "protocols/wire/writer.h"

namespace echoloop::wire {

template <class T>
void write_section(Writer& writer, const T& body) {
    const std::size_t start = writer.out.size();
    std::copy(layout<T>.tag.begin(), layout<T>.tag.end(), writer.grow(4));
    write_fields(writer, body);
    writer.grow((4 - writer.out.size() % 4) % 4);
    const std::size_t size = writer.out.size() - start;
    assert(size <= std::numeric_limits<std::uint16_t>::max() && "a section holds at most 65535 bytes");
    store<ByteOrder::big>(static_cast<std::uint16_t>(size), writer.out.data() + start + 2);
}

template <class M, class T>
void write_field(Writer& writer, const M& message, const Section<M, T>& field) {
    const T& value = message.*field.member;
    if constexpr (is_variant<T>) {
        std::visit([&](const auto& body) { write_section(writer, body); }, value);
    } else if constexpr (is_optional<T>) {
        if (value) write_section(writer, *value);
    } else {
        write_section(writer, value);
    }
}

template <class M, class V>
void write_field(Writer& writer, const M& message, const List<M, V>& field) {
    write_elements<layout<M>.order>(writer, message.*field.member, (message.*field.member).size());
}

template <class M, class V>
void write_field(Writer& writer, const M& message, const TaggedList<M, V>& field) {
    const auto write_one = [&]<class T>(const T& section) {
        if constexpr (HasLayout<T>) {
            std::copy(layout<T>.tag.begin(), layout<T>.tag.end(), writer.grow(4));
            write_fields(writer, section);
        } else {
            write_value<layout<M>.order>(writer, section.name);
            write_elements<layout<M>.order>(writer, section.words, tagged_words(section.name.chars[3]));
        }
    };
    for (const auto& section : message.*field.member) std::visit(write_one, section);
}

}  // namespace echoloop::wire
