// How sections and lists of structs are read. Include read.h to use it.
#pragma once

#include "protocols/wire/reader.h"

namespace echoloop::wire {

/// Enters a section whose tag is known to be right; `outer` receives the end to restore.
bool enter_section(Reader& reader, std::size_t& outer, std::string_view name);
/// Skips the padding and restores the end.
bool leave_section(Reader& reader, std::size_t outer, std::string_view name);

template <class T>
bool read_section(Reader& reader, T& body) {
    static_assert(layout<T>.tag.size() == 2);
    std::size_t outer = 0;
    return enter_section(reader, outer, layout<T>.name) && read_fields(reader, body) &&
           leave_section(reader, outer, layout<T>.name);
}

/// The alternative whose tag stands here; nothing happens if there is none.
template <class Alternative, class Variant>
bool try_alternative(Reader& reader, Variant& value, bool& good) {
    if (!starts_with(reader, layout<Alternative>.tag)) return false;
    good = read_section(reader, value.template emplace<Alternative>());
    return true;
}

template <class M, class... T>
bool read_choice(Reader& reader, std::variant<T...>& value, std::string_view name) {
    bool good = false;
    if ((try_alternative<T>(reader, value, good) || ...)) return good;
    return reader.fail(reader.left() < 2 ? Reason::truncated : Reason::wrong_section, layout<M>.name, name);
}

template <class M, class T>
bool read_field(Reader& reader, M& message, const Section<M, T>& field) {
    T& value = message.*field.member;
    if constexpr (is_variant<T>) {
        return read_choice<M>(reader, value, field.meta.name);
    } else if constexpr (is_optional<T>) {
        if (!starts_with(reader, layout<typename T::value_type>.tag)) return true;
        return read_section(reader, value.emplace());
    } else {
        if (starts_with(reader, layout<T>.tag)) return read_section(reader, value);
        return reader.fail(reader.left() < 2 ? Reason::truncated : Reason::wrong_section, layout<M>.name,
                           field.meta.name);
    }
}

template <class M, class V>
bool read_field(Reader& reader, M& message, const List<M, V>& field) {
    constexpr std::size_t size = *fixed_size<typename V::value_type>();
    const std::size_t left = reader.left();
    if (!read_elements<M>(reader, message.*field.member, left / size, field.meta.name)) return false;
    return left % size == 0 || reader.fail(Reason::truncated, layout<M>.name, field.meta.name);
}

/// True if the tag stands here, whatever the case of its 4th character.
bool tag_here(const Reader& reader, std::string_view tag);

template <class M, class Alternative, class V>
bool try_tagged(Reader& reader, V& list, bool& good) {
    if constexpr (HasLayout<Alternative>) {
        static_assert(fixed_size<Alternative>() == tagged_words(layout<Alternative>.tag[3]) * 4);
        if (!tag_here(reader, layout<Alternative>.tag)) return false;
        reader.position += 4;
        good = read_fields(reader, std::get<Alternative>(list.emplace_back(Alternative{})));
        return true;
    } else {
        Alternative unknown;
        if (!read_value<M>(reader, unknown.name, "name")) {
            good = false;
            return true;
        }
        const std::size_t words = tagged_words(unknown.name.chars[3]);
        good = words > 0 ? read_elements<M>(reader, unknown.words, words, "words")
                         : reader.fail(Reason::wrong_section, layout<M>.name, "name");
        list.emplace_back(std::move(unknown));
        return true;
    }
}

template <class M, class... T>
bool read_tagged(Reader& reader, std::vector<std::variant<T...>>& list) {
    bool good = true;
    while (good && reader.left() > 0) (try_tagged<M, T>(reader, list, good) || ...);
    return good;
}

template <class M, class V>
bool read_field(Reader& reader, M& message, const TaggedList<M, V>& field) {
    return read_tagged<M>(reader, message.*field.member);
}

}  // namespace echoloop::wire
