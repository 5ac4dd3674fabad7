// What a recording says in a comment about a ping.
#pragma once

#include <cstdint>
#include <string>

#include "emulator/contract/transmission.h"

namespace echoloop {

/// "ping 12: t 1.234 s, sonar at 1.000 2.000 -3.000 m, orientation w 1.0000 x 0.0000 y 0.0000 z 0.0000".
std::string remark_of(const Transmission& transmission, std::uint64_t number);

}  // namespace echoloop
