// The `mount` of a device: where its sonar is on the vehicle, and how that moves.
#pragma once

#include <string>

#include "emulator/scenario/scenario.h"
#include "emulator/scenario/value.h"

namespace echoloop::scenario {

/// Fills the mount_... members of `device`. `value`: the map, or nullptr.
void read_mount(const Value* value, const std::string& path, const Scenario& scenario, ScenarioDevice& device,
                Problems& problems);

}  // namespace echoloop::scenario
