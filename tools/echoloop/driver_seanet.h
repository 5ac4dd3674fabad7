// Drivers of Tritech's SeaNet sonars, which open a serial port: what to write into their configuration.
#pragma once

#include <string>

#include "tools/echoloop/driver.h"

namespace echoloop::cli {

/// An empty hint if no driver is known.
DriverHint seanet_driver_hint(const ScenarioDevice& device, const std::string& format);

}  // namespace echoloop::cli
