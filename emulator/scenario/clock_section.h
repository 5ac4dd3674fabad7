// The scenario's clock: how the run's time passes, and who moves it on.
#pragma once

#include "emulator/scenario/scenario.h"
#include "emulator/scenario/section.h"

namespace echoloop::scenario {

/// Reads `clock` into the scenario, whose pose_input is known already.
void read_clock(const Section& top, Scenario& scenario, Problems& problems);

}  // namespace echoloop::scenario
