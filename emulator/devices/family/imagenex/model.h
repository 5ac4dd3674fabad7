// What Imagenex heads have in common in the table of models: their line, and the ping of a plain host. Rows
// only; knows no device.
#pragma once

#include <string>

#include "emulator/devices/family/imagenex/settings.h"
#include "protocols/imagenex/messages.h"

namespace echoloop::imagenex_head {

/// A row of the table that lacks the head's options and figures, its device and its ping.
Model model_of(const std::string& name, const std::string& title);

/// The ping of a host that asks for 500 points out to `range` m, the default if it is 0; `longest`: of the
/// head. `command` is what else it says, `true_sound_speed` is in m/s. The model numbers it, aims it and
/// gives it its sound.
Shot plain_ping(imagenex::SwitchCommand command, double range, double longest, const Settings& settings,
                double true_sound_speed);

}  // namespace echoloop::imagenex_head
