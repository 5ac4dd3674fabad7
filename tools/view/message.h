// What messages for the page have in common: JSON in front, bytes behind.
#pragma once

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace echoloop::view {

using Json = nlohmann::ordered_json;

inline void put_le(std::string& out, std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

inline Json rounded(const std::vector<double>& values) {
    Json all = Json::array();
    for (const double value : values) all.push_back(std::round(value * 1e5) / 1e5);
    return all;
}

/// Four bytes of length (little endian), that much JSON, then `bytes`.
inline std::string with_head(const Json& head, const std::string& bytes) {
    const std::string text = head.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string message;
    message.reserve(4 + text.size() + bytes.size());
    put_le(message, static_cast<std::uint32_t>(text.size()), 4);
    return message + text + bytes;
}

}  // namespace echoloop::view
