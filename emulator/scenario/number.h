// Numbers as scenarios and --set write them: decimal, the point as separator in every locale. Knows no
// bounds.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace echoloop::scenario {

template <typename Number>
std::optional<Number> parse_as(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    if (text.starts_with('+') || text.empty()) return {};
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return value;
}

/// Accepts "inf" and "nan", and YAML's spelling of them, so that the caller can name the real fault.
inline std::optional<double> parse_number(std::string_view text) {
    const bool negative = text.starts_with('-');
    const auto bare = text.substr(negative || text.starts_with('+') ? 1 : 0);
    if (bare.starts_with('.') && bare.size() > 1 && (bare[1] < '0' || bare[1] > '9')) text = bare.substr(1);
    return parse_as<double>(text);
}

}  // namespace echoloop::scenario
