// The `faults` of a scenario, and one fault as the control socket takes it. Reads and checks; makes none.
#pragma once

#include <span>
#include <vector>

#include "emulator/scenario/fault.h"
#include "emulator/scenario/scenario.h"
#include "emulator/scenario/section.h"

namespace echoloop::scenario {

/// `value` is the list, or nullptr. `devices` may lack some that are themselves in error.
std::vector<Fault> read_faults(const Value* value, std::span<const ScenarioDevice> devices,
                               Problems& problems);

/// One fault, called `path` in messages; without a time of its own it begins at `now`. Whole only if it adds
/// no problem.
Fault read_fault(const Value& value, const std::string& path, std::span<const ScenarioDevice> devices,
                 Time now, Problems& problems);

}  // namespace echoloop::scenario
