// What to write into the configuration of a driver so that it finds an emulated sonar, from what its model
// says of itself (emulator/contract/known_driver.h). Opens nothing.
#pragma once

#include <string>
#include <vector>

#include "emulator/scenario/scenario.h"

namespace echoloop::cli {

/// One place on the wire: "commands" at "127.0.0.1:65502".
struct WirePlace {
    std::string what;
    std::string address;
};

/// "commands                  127.0.0.1:65502", in columns.
std::string place_line(const WirePlace& place);

/// Where a device can be reached and where it sends to. A listening port whose number is left to the program
/// (port 0) is said to be chosen at the start.
std::vector<WirePlace> wire_places(const ScenarioDevice& device);

struct DriverHint {
    std::string driver;              ///< project; empty if none is known
    std::vector<std::string> paste;  ///< lines for its configuration or a shell
    std::string note;
};

/// There is none for a port whose number is not known yet. `format`: "ros1", "ros2", "moos", "rock", "dune",
/// "sitl", "python".
DriverHint driver_hint(const ScenarioDevice& device, const std::string& format);

const std::vector<std::string>& driver_formats();

}  // namespace echoloop::cli
