// Drivers of Tritech's SeaNet sonars, which open a serial port: what to write into their configuration.
#pragma once

#include <string>

#include "emulator/endpoint.h"
#include "tools/echoloop/driver.h"

namespace echoloop::cli {

/// "/tmp/echoloop/micron, 115200 bit/s 8N1", "TCP, connect to 127.0.0.1:9090". `rate`: bit/s where the
/// endpoint names none.
std::string stream_address(const Endpoint& endpoint, int rate);

/// An empty hint if no driver is known.
DriverHint seanet_driver_hint(const ScenarioDevice& device, const std::string& format);

}  // namespace echoloop::cli
