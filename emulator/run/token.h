// The first line of a client by TCP at the control place. Takes any text.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace echoloop {

/// Whether it is {"token": "..."} with that token.
inline bool tells_token(std::string_view line, std::string_view token) {
    const auto said = nlohmann::json::parse(line, nullptr, false);
    return said.is_object() && said.contains("token") && said["token"] == token;
}

}  // namespace echoloop
