// The commands of a Teledyne DVL's console, and what it answers. Pure functions; know no line.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/devices/teledyne-dvl/settings.h"

namespace echoloop::teledyne_dvl {

/// What a command asks for beyond its settings.
struct Reply {
    std::string text{};  ///< behind the command's echo
    bool good = true;
    bool start = false, wake = false;     ///< CS; as after a break
    std::optional<std::int64_t> clock{};  ///< TS: us, Unix time
};

/// Of a line without its end; `now`: us, Unix time by its clock.
Reply obey(std::string_view line, Setup& setup, const Settings& settings, std::int64_t now);
/// What it says after a break: three lines of who it is, its firmware, and the prompt.
std::string banner(const Settings& settings);

}  // namespace echoloop::teledyne_dvl
