// What Imagenex heads have in common in the table of models: their line, and the ping of a plain host. Rows
// only; knows no device.
#pragma once

#include <string>

#include "emulator/contract/model.h"
#include "protocols/imagenex/messages.h"

namespace echoloop::imagenex_head {

/// A row of the table that lacks the head's own options, its device and its ping.
Model model_of(const std::string& name, const std::string& title);

/// The ping of a host that asks for 500 points out to `range` m, the default if it is 0; `longest`: of the
/// head. `command` is what else it says. Numbered after `step`; the model aims it and gives it its sound.
Shot plain_ping(imagenex::SwitchCommand command, double range, double longest, const DeviceConfig& config,
                std::size_t step);

}  // namespace echoloop::imagenex_head
