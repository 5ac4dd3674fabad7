// Where a run is controlled from: a socket file, or a TCP port of this machine. Parses and prints; opens
// nothing.
#pragma once

#include <string>
#include <string_view>

#include "emulator/contract/device.h"

namespace echoloop {

struct ControlPlace {
    std::string path{};  ///< of a unix socket; "": TCP
    Address address{};
};

/// "unix:/tmp/echoloop/control" or "tcp-listen://127.0.0.1:9600"; port 0 lets the system choose. Throws
/// std::invalid_argument with a sentence for the user.
ControlPlace parse_control_place(std::string_view text);

}  // namespace echoloop
