// `layout<Message>`: one constexpr table of fields per message, from which everything else follows. Never
// holds code of a protocol: a new family is a set of these tables.
#pragma once

#include <array>
#include <concepts>
#include <optional>
#include <string_view>
#include <tuple>
#include <variant>

#include "protocols/wire/field.h"
#include "protocols/wire/text.h"

namespace echoloop::wire {

/// The table of message M. `base` is the offset that the specification gives to the first byte.
template <class M, class... Fields>
struct Layout {
    std::string_view name;
    std::string_view tag;  ///< of a section; empty otherwise
    std::string_view help;
    ByteOrder order = ByteOrder::little;
    std::size_t base = 0;
    std::tuple<Fields...> fields;
};

/// What stands before the fields of a table.
struct Heading {
    std::string_view name;
    std::string_view help;
    ByteOrder order = ByteOrder::little;
    std::size_t base = 0;
    std::string_view tag{};
};

template <class M, class... Fields>
constexpr Layout<M, Fields...> make_layout(Heading heading, Fields... fields) {
    return {heading.name, heading.tag, heading.help, heading.order, heading.base, {fields...}};
}

struct NoLayout {};
template <class M>
struct Tag {};

/// The table of M: what `wire_layout(Tag<M>)` returns, a constexpr function beside M that each family writes
/// once per message. The header with the tables must come before the first use of them.
template <class M>
inline constexpr auto layout = [] {
    if constexpr (requires { wire_layout(Tag<M>{}); }) {
        return wire_layout(Tag<M>{});
    } else {
        return NoLayout{};
    }
}();

template <class T>
concept HasLayout = !std::same_as<std::remove_cvref_t<decltype(layout<T>)>, NoLayout>;

template <class T>
inline constexpr bool is_text = false;
template <std::size_t N>
inline constexpr bool is_text<Text<N>> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t N>
inline constexpr bool is_array<std::array<T, N>> = true;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_variant = false;
template <class... T>
inline constexpr bool is_variant<std::variant<T...>> = true;

/// Words that the 4th character of a status section announces; 0 if it is not 1-9, A-Z or a-z.
constexpr std::size_t tagged_words(char fourth) {
    if (fourth >= '1' && fourth <= '9') return static_cast<std::size_t>(fourth - '0');
    if (fourth >= 'A' && fourth <= 'Z') return static_cast<std::size_t>(fourth - 'A') + 10;
    if (fourth >= 'a' && fourth <= 'z') return static_cast<std::size_t>(fourth - 'a') + 10;
    return 0;
}

using FixedSize = std::optional<std::size_t>;

template <class T>
constexpr FixedSize fixed_size();

// Sizes of the field kinds; a kind without an overload here has no fixed size.
template <class M, class T>
constexpr FixedSize field_size(const Member<M, T>&) {
    return fixed_size<T>();
}
template <class Wire>
constexpr FixedSize field_size(const Count<Wire>&) {
    if constexpr (std::is_same_v<Wire, HexDigits4>) {
        return 4;
    } else {
        return sizeof(Wire);
    }
}
template <class M, class T>
constexpr FixedSize field_size(const CountMember<M, T>&) {
    return sizeof(T);
}
template <class T>
constexpr FixedSize field_size(const Constant<T>&) {
    return sizeof(T);
}
constexpr FixedSize field_size(const Magic& field) { return field.value.size(); }
template <class T>
constexpr FixedSize field_size(const TotalSize<T>&) {
    return sizeof(T);
}
template <class Field>
constexpr FixedSize field_size(const Field&) {
    return std::nullopt;
}

/// Bytes of a T on the wire, or nothing if they depend on its content.
template <class T>
constexpr FixedSize fixed_size() {
    if constexpr (Scalar<T>) {
        return sizeof(T);
    } else if constexpr (is_text<T>) {
        return sizeof(T::chars);
    } else if constexpr (is_array<T>) {
        return std::tuple_size_v<T> * *fixed_size<typename T::value_type>();
    } else {
        static_assert(HasLayout<T>, "a struct on the wire needs a layout");
        return std::apply(
            [](const auto&... fields) {
                FixedSize total = 0;
                [[maybe_unused]] const auto add = [&](FixedSize size) {
                    total = total && size ? FixedSize(*total + *size) : std::nullopt;
                };
                (add(field_size(fields)), ...);
                return total;
            },
            layout<T>.fields);
    }
}

}  // namespace echoloop::wire
