// The ports of a device, open, with numbers for those that the scenario leaves to the program.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "emulator/scenario/scenario.h"
#include "emulator/transport/make.h"

namespace echoloop {

/// A port, and where the world finds it: for a stream its endpoint, for a datagram port its own address.
struct PortPlace {
    std::string name;
    Endpoint place;
};

struct OpenPorts {
    std::vector<Endpoint> endpoints;  ///< as in the scenario, all with their numbers
    std::vector<std::unique_ptr<Transport>> transports;
    std::vector<PortPlace> places;  ///< as `transports`
};

/// Whether somebody outside is at the other end, or what the scenario has for it (ScenarioDevice::script).
enum class Drivers { outside, scripted };

/// `around`: as for make_transports. Throws StartError.
OpenPorts open_ports(Clock& clock, const ScenarioDevice& device, Drivers drivers, const Around& around);

}  // namespace echoloop
