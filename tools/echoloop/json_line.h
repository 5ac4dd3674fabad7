#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace echoloop::cli {

/// Without spaces and line feeds. Bytes that are no UTF-8 become U+FFFD.
inline std::string line_of(const nlohmann::ordered_json& json) {
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace echoloop::cli
