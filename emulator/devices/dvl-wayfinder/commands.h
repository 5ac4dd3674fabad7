// The commands of a Wayfinder, and what it answers. Pure functions; know no line.
#pragma once

#include <optional>

#include "emulator/devices/dvl-wayfinder/settings.h"
#include "protocols/wayfinder/messages.h"

namespace echoloop::dvl_wayfinder {

/// What commands change.
struct State {
    wayfinder::Setup setup;
    bool pinging = false;
};
/// As options have it.
State state_of(const Settings& settings);

struct Answer {
    wayfinder::Body body;
    bool trigger = false;                 ///< a ping is asked for
    std::optional<std::int64_t> clock{};  ///< us, Unix time that was set
};

/// `now`: us, Unix time by its clock. Nothing: the bytes are no command.
std::optional<Answer> obey(const wayfinder::Body& command, State& state, const Settings& settings,
                           std::int64_t now);

/// bit/s of the line by its setup.
double baud_of(const wayfinder::Setup& setup);
/// Of the emulated firmware.
inline constexpr std::array<std::uint8_t, 4> firmware{1, 0, 0, 24};

}  // namespace echoloop::dvl_wayfinder
