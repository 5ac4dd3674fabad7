// A ping as it went out: what the rest of the run may know of it, whether it hears it, records it or tells
// its truth.
#pragma once

#include "emulator/contract/device.h"
#include "render/pose.h"

namespace echoloop {

/// One pulse into the water.
struct Transmission {
    Time time{};             ///< when it began
    std::size_t device = 0;  ///< which sonar's
    Pose world_from_sonar;
    Shot shot;  ///< its bins are of no use here
};

}  // namespace echoloop
