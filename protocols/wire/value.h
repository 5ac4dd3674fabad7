// A field of a message as people and JSON want it: name, place, unit and value. Knows no layout.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocols/wire/field.h"

namespace echoloop::wire {

/// Unsigned, signed, real, characters, or an array of numbers. A 32-bit float becomes the double with the
/// same shortest decimal, so that 0.1f reads 0.1.
using Value = std::variant<std::uint64_t, std::int64_t, double, std::string, std::vector<double>>;

struct FieldView {
    std::string name{};  ///< with the names around it: "h0.points"
    std::string_view unit{};
    std::string_view help{};
    std::size_t offset = 0;  ///< as the layout of the outermost message counts
    std::size_t size = 0;    ///< bytes on the wire
    Format format = Format::plain;
    std::span<const NamedValue> names{};
    Value value{};
};

/// The value for people: enumerators and bits by name, long arrays cut, characters that could harm a terminal
/// escaped.
std::string value_text(const FieldView& field);

/// The double that prints like the float.
double readable(float value);

template <class T>
double readable(T value) {
    return static_cast<double>(value);
}

}  // namespace echoloop::wire
