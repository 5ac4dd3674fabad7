// The commands of a Nortek DVL, and what it answers. Pure functions; know no line.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/devices/family/nortek/setup.h"
#include "emulator/devices/nortek-dvl/settings.h"

namespace echoloop::nortek_dvl {

using nortek_console::number_of;
using nortek_console::Setup;

/// As it is after SETDEFAULT: of options, and own choices.
Setup default_setup(const Settings& settings);
/// What a ping goes out at, by SETDVL,TRIG.
Trigger trigger_of(const Setup& setup);
bool tracks_water(const Setup& setup);

/// What it listens to differs: measuring goes on by itself, and a break makes it ask whether it shall.
enum class Mode { command, measuring, confirmation };

/// What commands read and change.
struct State {
    Setup setup;
    Mode mode = Mode::command;
    bool broke = false;  ///< it was woken by a break
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
/// Of a break, which is no line.
Answer answer_break(State& state, const Settings& settings);

}  // namespace echoloop::nortek_dvl
