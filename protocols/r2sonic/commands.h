// The names of R2Sonic's settings with their type, unit and meaning. A table only: devices decide what to
// obey.
#pragma once

#include <span>
#include <string_view>

#include "protocols/wire/table.h"

namespace echoloop::r2sonic {

struct CommandInfo {
    std::string_view name;  ///< e.g. "RNG0"
    bool real;              ///< f32, else u32
    std::string_view unit;
    std::string_view help;
};

std::span<const CommandInfo> commands();

/// The row of a name; also of the MultiMode forms (ABS1 to ABS4 are read like ABS0). nullptr if unknown. PTS0
/// means pitch stabilisation to the head and the sound velocity port to the SIM; both are u32.
const CommandInfo* find_command(std::string_view name);

/// All of them as a table for the documentation.
wire::Table command_table();

}  // namespace echoloop::r2sonic
