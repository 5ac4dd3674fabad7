// Tells a bottom from the water before it, in which something floats everywhere. Pure functions; knows no
// device.
#pragma once

#include <cstddef>

#include "render/echogram.h"

namespace echoloop::echosounder {

/// Where only water is heard, its speckle leaves up to 12 dB for the mean of a footprint, and some more for
/// one bin. Own choices; a bottom has 30 dB and more, in turbid water, too.
inline constexpr double footprint_margin = 15, bin_margin = 20;  // dB

/// Whether an echo of `power` (uPa^2) at `bin` stands out of the water before it, with the gain that gives
/// back spreading, by which the water is as loud at every range: of four places about 0.6 of the time the
/// quietest counts, so that a ring or a shoal hides no bottom. `margin`: dB above that.
bool stands_out_of_water(const Echogram& echogram, std::size_t beam, std::size_t bin, double power,
                         double margin);

}  // namespace echoloop::echosounder
