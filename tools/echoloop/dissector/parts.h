// The hand-written Lua of Wireshark's dissector, built into the program. Text only.
#pragma once

#include <string_view>

namespace echoloop::cli {

/// A file of tools/echoloop/dissector by its name without folder and ending. Throws std::logic_error if there
/// is none.
std::string_view lua_part(std::string_view name);

}  // namespace echoloop::cli
