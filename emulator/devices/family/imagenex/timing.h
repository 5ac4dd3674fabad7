// When an Imagenex head answers. Pure functions of the command; knows no clock.
#pragma once

#include "emulator/contract/device.h"
#include "emulator/devices/family/imagenex/settings.h"
#include "protocols/imagenex/messages.h"

namespace echoloop::imagenex_head {

/// From the command to the end of its reply of `reply_bytes`, without the switch delay.
double shot_seconds(const imagenex::SwitchCommand& command, std::size_t reply_bytes,
                    const Settings& settings);

/// From the command to the moment at which the reply is handed to the line, switch delay included: where the
/// line has a rate of its own, as much earlier as the line takes.
Time answer_time(const imagenex::SwitchCommand& command, std::size_t reply_bytes, const Settings& settings);

/// bit/s that byte 21 of a command asks of its reply; 0: none of them, or heads of this kind ignore it.
double asked_rate(std::uint8_t reply_baud, const Settings& settings);

/// What `bytes` of the reply to `command` take on the line; 0 where it has no rate.
Time line_time(const imagenex::SwitchCommand& command, std::size_t bytes, const Settings& settings);

/// s that the motor takes for a step of 0.3 deg.
inline constexpr double step_seconds = 2.4e-3;

}  // namespace echoloop::imagenex_head
