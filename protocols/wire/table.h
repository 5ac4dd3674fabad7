// A layout as rows, without a message: what documentation and generated dissectors are made from. Never sees
// bytes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/wire/layout.h"

namespace echoloop::wire {

enum class Kind {
    value,
    group,
    count,
    counted,
    constant,
    magic,
    total_size,
    rest,
    section,
    list,
    tagged_list
};

/// One field of a table. Nested structs, sections and lists are tables of their own, named in `tables`.
struct Row {
    Kind kind = Kind::value;
    Meta meta{};
    std::string type{};  ///< of one element: "u16", "f32", "char[12]", or the name of a table
    std::optional<std::size_t> offset{};  ///< nothing behind a field of unknown size
    FixedSize size{};                     ///< bytes in all; nothing if the content decides
    std::size_t elements = 1;             ///< of an array of fixed length
    CountRef count{""};                   ///< kind counted: where the number of elements comes from
    std::string_view key{};               ///< kind count: what it counts
    std::int64_t bias = 0;                ///< kind count: raw value - elements
    std::uint64_t constant = 0;           ///< kind constant
    std::string_view characters{};        ///< kind magic
    std::vector<std::string> tables{};    ///< the tables that may stand here
    bool optional = false;                ///< kind section
};

struct Table {
    std::string name{};
    std::string tag{};  ///< of a section
    std::string help{};
    ByteOrder order = ByteOrder::little;
    std::size_t base = 0;
    std::vector<Row> rows{};
};

/// "u8" .. "u64", "i8" .. "i64", "f32", "f64", "char[n]", or the name of a struct's table.
template <class T>
std::string type_name() {
    if constexpr (HasLayout<T>) {
        return std::string(layout<T>.name);
    } else if constexpr (is_text<T>) {
        return "char[" + std::to_string(sizeof(T::chars)) + "]";
    } else if constexpr (is_array<T>) {
        return type_name<typename T::value_type>();
    } else {
        const char letter = std::is_floating_point_v<T> ? 'f' : std::is_signed_v<T> ? 'i' : 'u';
        return letter + std::to_string(8 * sizeof(T));
    }
}

template <class T>
Row value_row(const Meta& meta) {
    Row row{.kind = HasLayout<T> ? Kind::group : Kind::value, .meta = meta, .type = type_name<T>()};
    if constexpr (HasLayout<T>) row.tables = {row.type};
    if constexpr (is_array<T>) row.elements = std::tuple_size_v<T>;
    if constexpr (Scalar<T>) {
        if (row.meta.names.empty()) row.meta.names = value_names<T>;
    }
    return row;
}

template <class M, class T>
Row row_of(const Member<M, T>& f) {
    return value_row<T>(f.meta);
}
template <class Wire>
Row row_of(const Count<Wire>& f) {
    Row row{.kind = Kind::count, .meta = f.meta, .key = f.key, .bias = f.bias};
    if constexpr (std::is_same_v<Wire, HexDigits4>) {
        row.type = "hex[4]";
    } else {
        row.type = type_name<Wire>();
    }
    return row;
}
template <class M, class T>
Row row_of(const CountMember<M, T>& f) {
    return {.kind = Kind::count, .meta = f.meta, .type = type_name<T>(), .key = f.key};
}
template <class M, class V>
Row row_of(const Counted<M, V>& f) {
    Row row = value_row<typename V::value_type>(f.meta);
    row.kind = Kind::counted;
    row.count = f.count;
    return row;
}
template <class T>
Row row_of(const Constant<T>& f) {
    Row row = value_row<T>(f.meta);
    row.kind = Kind::constant;
    row.constant = static_cast<std::uint64_t>(f.value);
    return row;
}
inline Row row_of(const Magic& f) {
    return {.kind = Kind::magic,
            .meta = f.meta,
            .type = "char[" + std::to_string(f.value.size()) + "]",
            .characters = f.value};
}
template <class T>
Row row_of(const TotalSize<T>& f) {
    return {.kind = Kind::total_size, .meta = f.meta, .type = type_name<T>()};
}
template <class M>
Row row_of(const Rest<M>& f) {
    return {.kind = Kind::rest, .meta = f.meta, .type = "u8"};
}

template <class T>
struct TablesOf {
    static std::vector<std::string> names() { return {std::string(layout<T>.name)}; }
};
template <class T>
struct TablesOf<std::optional<T>> : TablesOf<T> {};
template <class... T>
struct TablesOf<std::variant<T...>> {
    static std::vector<std::string> names() {
        std::vector<std::string> out;
        const auto add = [&]<class A>(const A*) {
            if constexpr (HasLayout<A>) out.emplace_back(layout<A>.name);
        };
        (add(static_cast<const T*>(nullptr)), ...);
        return out;
    }
};

template <class M, class T>
Row row_of(const Section<M, T>& f) {
    return {.kind = Kind::section,
            .meta = f.meta,
            .type = "section",
            .tables = TablesOf<T>::names(),
            .optional = is_optional<T>};
}
template <class M, class V>
Row row_of(const List<M, V>& f) {
    using T = typename V::value_type;
    return {.kind = Kind::list, .meta = f.meta, .type = type_name<T>(), .tables = TablesOf<T>::names()};
}
template <class M, class V>
Row row_of(const TaggedList<M, V>& f) {
    using T = typename V::value_type;
    return {.kind = Kind::tagged_list, .meta = f.meta, .type = "section", .tables = TablesOf<T>::names()};
}

/// The table of one message.
template <class M>
Table table_of() {
    const auto& from = layout<M>;
    Table table{
        std::string(from.name), std::string(from.tag), std::string(from.help), from.order, from.base, {}};
    std::optional<std::size_t> offset = from.base;
    const auto add = [&](const auto& f) {
        Row row = row_of(f);
        row.offset = offset;
        row.size = field_size(f);
        offset = offset && row.size ? std::optional(*offset + *row.size) : std::nullopt;
        table.rows.push_back(std::move(row));
    };
    std::apply([&](const auto&... fields) { (add(fields), ...); }, from.fields);
    return table;
}

/// A heading and a Markdown table: offset, type, field, unit, meaning.
std::string markdown(const Table& table);

}  // namespace echoloop::wire
