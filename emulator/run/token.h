// What lets a client in who could be anybody on this machine: random digits that the run printed.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace echoloop {

/// 128 random bits as hexadecimal digits. Throws StartError.
std::string random_token();

/// Whether `line` is {"token": "..."} with that token. Takes any text.
inline bool tells_token(std::string_view line, std::string_view token) {
    const auto said = nlohmann::json::parse(line, nullptr, false);
    return said.is_object() && said.contains("token") && said["token"] == token;
}

}  // namespace echoloop
