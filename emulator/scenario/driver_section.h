// What a driver of the scenario itself says to a device in a free run: `driver`, lines with their times, or
// `pings`, a plain driver's requests at an interval.
#pragma once

#include "emulator/scenario/scenario.h"
#include "emulator/scenario/section.h"

namespace echoloop::scenario {

/// `device` is complete but for its script. `driver` may name a file, which begins at the scenario's folder.
void read_driver(const Section& section, const Scenario& scenario, ScenarioDevice& device,
                 Problems& problems);

}  // namespace echoloop::scenario
