// What a transducer that both sends and hears still hears of its own pulse. Pure functions; knows no device.
#pragma once

#include "render/echogram.h"

namespace echoloop::echosounder {

/// The receiver hears the pulse at `level` from `start` on while it is sent, and for `hold` at least;
/// afterwards the transducer rings on and dies away.
struct RingDown {
    double level = 0;  ///< dB re 1 uPa, as if it had come from the water
    double decay = 0;  ///< dB per s
    double start = 0;  ///< s
    double hold = 0;   ///< s
};

/// Mean power in uPa^2 that the ring-down has in a bin.
double ring_down_power(const RingDown& ring, const Shot& shot, std::size_t bin);

/// The echogram with the ring-down in every beam; unchanged under the paper's rule, which has no power.
Echogram with_ring_down(Echogram echogram, const RingDown& ring);

}  // namespace echoloop::echosounder
