// The kinds of fields that a layout is made of, and the functions that name them in a table. Data only:
// read.h, write.h, visit.h and table.h say what is done with each kind.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "protocols/wire/bytes.h"

namespace echoloop::wire {

/// A number with a name: an enumerator, or one bit of a flag word.
struct NamedValue {
    std::uint64_t value = 0;
    std::string_view name;
};

/// Names of an enum's values; a specialisation per enum that has them.
template <class E>
inline constexpr std::span<const NamedValue> value_names{};

enum class Format { plain, hex, bits, ipv4 };

/// What is said of every field, whatever its kind.
struct Meta {
    std::string_view name;
    std::string_view unit;
    std::string_view help;
    Format format = Format::plain;
    std::span<const NamedValue> names{};  ///< enumerators, or bits if format is bits
};

/// How many elements an array has: the product of one or two count fields that stand earlier, divided and
/// rounded up.
struct CountRef {
    std::string_view key;
    std::string_view times{};
    unsigned per = 1;

    constexpr CountRef(const char* one) : key(one) {}
    constexpr CountRef(const char* one, const char* two) : key(one), times(two) {}
    constexpr CountRef(const char* one, unsigned divisor) : key(one), per(divisor) {}
    /// The array's own size gives the count when it is written.
    constexpr bool is_identity() const { return times.empty() && per == 1; }
};

/// Four upper-case ASCII hex digits, as wire type of a count.
struct HexDigits4 {};

/// A member of the message: number, Text, array of numbers, or a struct that has a layout of its own.
template <class M, class T>
struct Member {
    T M::*member;
    Meta meta;

    constexpr Member hex() const {
        return {member, {meta.name, meta.unit, meta.help, Format::hex, meta.names}};
    }
    constexpr Member ipv4() const {
        return {member, {meta.name, meta.unit, meta.help, Format::ipv4, meta.names}};
    }
    constexpr Member bits(std::span<const NamedValue> names) const {
        return {member, {meta.name, meta.unit, meta.help, Format::bits, names}};
    }
};
template <class M, class T>
constexpr Member<M, T> field(T M::*member, std::string_view name, std::string_view unit,
                             std::string_view help) {
    return {member, {name, unit, help, Format::plain, {}}};
}

/// A count: raw = elements + bias. It has no member unless the struct wants to show it.
template <class Wire>
struct Count {
    std::string_view key;
    std::int64_t bias;
    Meta meta;
};
template <class Wire>
constexpr Count<Wire> count(std::string_view key, std::int64_t bias, std::string_view name,
                            std::string_view unit, std::string_view help) {
    return {key, bias, {name, unit, help, Format::plain, {}}};
}

/// A member that counts elements of arrays behind it.
template <class M, class T>
struct CountMember {
    T M::*member;
    std::string_view key;
    Meta meta;
};
template <class M, class T>
constexpr CountMember<M, T> count(T M::*member, std::string_view key, std::string_view name,
                                  std::string_view unit, std::string_view help) {
    return {member, key, {name, unit, help, Format::plain, {}}};
}

/// A vector of numbers, or of structs of fixed size, with as many elements as `count` says.
template <class M, class V>
struct Counted {
    V M::*member;
    CountRef count;
    Meta meta;
};
template <class M, class V>
constexpr Counted<M, V> counted(V M::*member, CountRef ref, std::string_view name, std::string_view unit,
                                std::string_view help) {
    return {member, ref, {name, unit, help, Format::plain, {}}};
}

/// A number that is always the same.
template <Scalar T>
struct Constant {
    T value;
    Meta meta;
};
template <Scalar T>
constexpr Constant<T> constant(T value, std::string_view name, std::string_view help) {
    return {value, {name, "", help, Format::hex, {}}};
}

/// Characters that are always the same, e.g. a packet's name.
struct Magic {
    std::string_view value;
    Meta meta;
};
constexpr Magic magic(std::string_view value, std::string_view name, std::string_view help) {
    return {value, {name, "", help, Format::plain, {}}};
}

/// Size of the whole message in bytes.
template <Scalar T>
struct TotalSize {
    Meta meta;
};
template <Scalar T>
constexpr TotalSize<T> total_size(std::string_view name, std::string_view help) {
    return {{name, "B", help, Format::plain, {}}};
}

/// All bytes that are left. `sizes`: the legal numbers of them, the usual one first; {}: any number.
template <class M>
struct Rest {
    std::vector<std::uint8_t> M::*member;
    std::array<std::size_t, 2> sizes;
    Meta meta;

    constexpr bool is_legal(std::size_t size) const {
        const bool any = sizes[0] == 0 && sizes[1] == 0;
        return any || size == sizes[0] || size == sizes[1];
    }
};
template <class M>
constexpr Rest<M> rest(std::vector<std::uint8_t> M::*member, std::array<std::size_t, 2> sizes,
                       std::string_view name, std::string_view unit, std::string_view help) {
    return {member, sizes, {name, unit, help, Format::plain, {}}};
}

/// A section {char tag[2]; u16 size with this header; body; zeros up to a multiple of 4}. T is a struct with
/// a tagged layout, a std::optional of one (may be absent), or a std::variant of several (one of them stands
/// here).
template <class M, class T>
struct Section {
    T M::*member;
    Meta meta;
};
template <class M, class T>
constexpr Section<M, T> section(T M::*member, std::string_view name, std::string_view help) {
    return {member, {name, "", help, Format::plain, {}}};
}

/// Structs of fixed size, one after the other up to the end.
template <class M, class V>
struct List {
    V M::*member;
    Meta meta;
};
template <class M, class V>
constexpr List<M, V> list(V M::*member, std::string_view name, std::string_view help) {
    return {member, {name, "", help, Format::plain, {}}};
}

/// {char tag[4]; u32 words[k]} in any order up to the end, k being the 4th character as a base-36 digit. The
/// elements are a std::variant of structs with tagged layouts; the last alternative {Text<4> name;
/// vector<u32> words} holds the unknown ones. The case of the 4th character does not matter in reading.
template <class M, class V>
struct TaggedList {
    V M::*member;
    Meta meta;
};
template <class M, class V>
constexpr TaggedList<M, V> tagged_list(V M::*member, std::string_view name, std::string_view help) {
    return {member, {name, "", help, Format::plain, {}}};
}

}  // namespace echoloop::wire
