// A pose of a scenario: metres in the world, or a place on the Earth.
#pragma once

#include <string>

#include "emulator/scenario/scenario.h"
#include "emulator/scenario/section.h"

namespace echoloop::scenario {

/// `position` or `latitude`, `longitude` and `altitude` or `depth`, and `rpy_deg`; identity for what is
/// absent. The origin is the scenario's, or else the one in the file of its scene, which is read only if it
/// is asked for.
Pose read_pose(const Value* value, const std::string& path, const Scenario& scenario, Problems& problems);

/// `position` and `rpy_deg`.
Pose pose_of(const Section& section);

}  // namespace echoloop::scenario
