// Drivers of sonars that a vehicle knows by name: Ping360 in ROS, range finders in ArduPilot, Oculus in
// ROS 2. What to write into their configuration; names of parameters are those of their public sources.
#pragma once

#include <string>

#include "tools/echoloop/driver.h"

namespace echoloop::cli {

/// An empty hint if no driver is known.
DriverHint vehicle_driver_hint(const ScenarioDevice& device, const std::string& format);

}  // namespace echoloop::cli
