#include "protocols/wire/value.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace echoloop::wire {

namespace {

constexpr std::size_t shown_elements = 8;

/// The shortest decimal that reads back as the same value; with an exponent only where a plain one would be
/// long.
template <class T>
std::string shortest(T value) {
    std::array<char, 64> buffer{};
    const double size = std::abs(static_cast<double>(value));
    const bool plain = size == 0 || (size >= 1e-4 && size < 1e15);
    const auto format = plain ? std::chars_format::fixed : std::chars_format::scientific;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format).ptr;
    return {buffer.data(), end};
}

std::string hex(std::uint64_t value, std::size_t bytes) {
    std::string out = "0x";
    for (std::size_t i = 2 * bytes; i > 0; --i) out += "0123456789abcdef"[(value >> (4 * (i - 1))) & 0xF];
    return out;
}

std::string ipv4(std::uint64_t value) {
    std::string out;
    for (const int shift : {24, 16, 8, 0}) {
        if (shift != 24) out += '.';
        out += std::to_string((value >> shift) & 0xFF);
    }
    return out;
}

std::string bit_text(std::uint64_t value, const FieldView& field) {
    std::string set;
    for (const NamedValue& bit : field.names) {
        if ((value & bit.value) == 0) continue;
        set.append(set.empty() ? "" : " ").append(bit.name);
    }
    return set.empty() ? hex(value, field.size) : hex(value, field.size) + " (" + set + ')';
}

std::string integer_text(std::uint64_t value, const FieldView& field) {
    switch (field.format) {
        case Format::bits:
            return bit_text(value, field);
        case Format::hex:
            return hex(value, field.size);
        case Format::ipv4:
            return ipv4(value);
        case Format::plain:
            break;
    }
    for (const NamedValue& known : field.names) {
        if (known.value == value) return std::to_string(value) + " (" + std::string(known.name) + ')';
    }
    return std::to_string(value);
}

std::string printable(const std::string& text) {
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool harmless = byte >= 0x20 && byte < 0x7F && c != '\\';
        out += harmless ? std::string(1, c) : "\\x" + hex(byte, 1).substr(2);
    }
    return out;
}

std::string array_text(const std::vector<double>& values, const FieldView& field) {
    std::string out = '[' + std::to_string(values.size()) + ']';
    for (std::size_t i = 0; i < std::min(values.size(), shown_elements); ++i) {
        out += ' ';
        out +=
            field.format == Format::ipv4 ? ipv4(static_cast<std::uint64_t>(values[i])) : shortest(values[i]);
    }
    return values.size() > shown_elements ? out + " ..." : out;
}

struct ToText {
    const FieldView& field;
    std::string operator()(std::uint64_t value) const { return integer_text(value, field); }
    std::string operator()(std::int64_t value) const { return std::to_string(value); }
    std::string operator()(double value) const { return shortest(value); }
    std::string operator()(const std::string& value) const { return printable(value); }
    std::string operator()(const std::vector<double>& value) const { return array_text(value, field); }
};

}  // namespace

std::string value_text(const FieldView& field) { return std::visit(ToText{field}, field.value); }

double readable(float value) {
    if (!std::isfinite(value)) return value;
    const std::string text = shortest(value);
    double out = value;
    std::from_chars(text.data(), text.data() + text.size(), out);
    return out;
}

}  // namespace echoloop::wire
