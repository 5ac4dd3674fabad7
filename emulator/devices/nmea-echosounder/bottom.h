// Finds the bottom in the echogram of a beam that looks down. Pure functions.
#pragma once

#include <optional>

#include "render/echogram.h"

namespace echoloop::nmea_echosounder {

struct BottomRule {
    double blanking = 0;  ///< s, two-way time before which nothing counts
    double margin = 15;   ///< dB above the noise
    double edge = 10;     ///< dB below the strongest echo
};

/// Two-way time in s of the leading edge of the first strong echo of beam 0; empty if there is none. Strong
/// is what stands clear of the noise and close to the strongest echo, once spreading over a flat bottom is
/// undone.
std::optional<double> bottom_time(const Echogram& echogram, const BottomRule& rule);

}  // namespace echoloop::nmea_echosounder
