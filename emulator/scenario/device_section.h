// The `devices` of a scenario against the table of models. Makes each device once to hear its own objections.
#pragma once

#include <span>
#include <vector>

#include "emulator/scenario/scenario.h"
#include "emulator/scenario/section.h"

namespace echoloop::scenario {

/// `value` is the list, or nullptr; `place` is where the complaint about a missing list belongs. The devices'
/// sound speed and seed are taken from `scenario`.
std::vector<ScenarioDevice> read_devices(const Value* value, const Place& place, const Scenario& scenario,
                                         std::span<const Model> models, Problems& problems);

/// The value of a key that is described as an option: from the section where given, else its default.
OptionValue read_option(const Option& option, const Section& section, Problems& problems);

/// Every option of the model: from `value` where given, else its default.
Options read_options(const Value* value, const std::string& path, const Model& model, Problems& problems);

}  // namespace echoloop::scenario
