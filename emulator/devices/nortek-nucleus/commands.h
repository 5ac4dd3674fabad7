// The commands of a Nucleus, and what it answers. Pure functions; know no line.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/devices/family/nortek/setup.h"
#include "emulator/devices/nortek-nucleus/settings.h"

namespace echoloop::nortek_nucleus {

using nortek_console::number_of;
using nortek_console::Setup;
Setup default_setup();
bool is_on(const Setup& setup, std::string_view group);  ///< its data stream, DS

/// What commands read and change.
struct State {
    Setup setup = default_setup();
    bool running = false;
    std::string error = "No error";
};

struct Answer {
    std::string text;  ///< lines with their ends
    bool good = true;
    bool trigger = false;
    std::optional<std::int64_t> clock{};  ///< us, Unix time, to which it is set
};

/// Of a line without its end, plain or as a sentence "$PNOR,...*hh", which is answered as such. `now`: us,
/// Unix time by its clock.
Answer answer(std::string_view line, State& state, const Settings& settings, std::int64_t now);

}  // namespace echoloop::nortek_nucleus
