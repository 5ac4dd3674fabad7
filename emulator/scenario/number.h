// Numbers as scenarios and --set write them: decimal, whole ones also hexadecimal, the point as separator in
// every locale. Knows no bounds.
#pragma once

#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace echoloop::scenario {

/// The number that the whole text is, with an optional sign.
template <typename Number>
std::optional<Number> parse_as(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    if (text.starts_with('+') || text.empty()) return {};
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size()) return {};
    if (error == std::errc::result_out_of_range && std::numeric_limits<Number>::has_infinity)
        return std::numeric_limits<Number>::infinity();
    return error == std::errc{} ? std::optional(value) : std::nullopt;
}

/// A whole number, also hexadecimal as YAML writes it: 0x8003.
inline std::optional<std::int64_t> parse_whole(std::string_view text) {
    if (!text.starts_with("0x")) return parse_as<std::int64_t>(text);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data() + 2, text.data() + text.size(), value, 16);
    const bool whole = error == std::errc{} && end == text.data() + text.size() && text[2] != '-';
    return whole ? std::optional(value) : std::nullopt;
}

/// Accepts "inf" and "nan", YAML's spelling of them, and numbers beyond all bounds (as infinity), so that the
/// caller can name the real fault.
inline std::optional<double> parse_number(std::string_view text) {
    const auto bare = text.substr(text.starts_with('-') || text.starts_with('+') ? 1 : 0);
    if (bare.starts_with('.') && bare.size() > 1 && (bare[1] < '0' || bare[1] > '9')) text = bare.substr(1);
    return parse_as<double>(text);
}

}  // namespace echoloop::scenario
