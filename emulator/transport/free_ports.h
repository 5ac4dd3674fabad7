// Numbers for the listening ports that a scenario leaves to the program by port 0. A device tells its drivers
// the numbers of its ports (discovery), so it is made with them. Opens nothing.
#pragma once

#include <string_view>
#include <vector>

#include "emulator/contract/endpoint.h"

namespace echoloop {

/// Whether a port of it is left to the program.
bool has_open_number(const std::vector<Endpoint>& endpoints);

/// The same endpoints with a number for each such port: others for each `attempt`, since somebody may have
/// them. `steady`: a name that gets the same numbers in every run; "": any.
std::vector<Endpoint> with_numbers(std::vector<Endpoint> endpoints, std::string_view steady,
                                   unsigned attempt);

}  // namespace echoloop
