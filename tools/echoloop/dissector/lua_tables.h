// The field tables of a protocol family as a Lua table, for the dissector that Wireshark loads. Writes text;
// knows no bytes of any message.
#pragma once

#include <string>
#include <string_view>

#include "protocols/inspect.h"

namespace echoloop::cli {

/// `{["HeadData"]={...}, ...}`: each table of the family with its rows, keys as dissector/fields.lua reads
/// them.
std::string lua_tables(const inspect::Family& family);

/// `{tcp="52100",serial=true}`.
std::string lua_places(const inspect::Places& places);

/// In double quotes, with everything escaped that Lua would read otherwise.
std::string lua_text(std::string_view text);

}  // namespace echoloop::cli
