// The image of an Oculus from an echogram, written once, into its message. Pure functions.
#pragma once

#include <span>

#include "emulator/devices/oculus/request.h"

namespace echoloop::oculus_device {

/// Power gain that a row `range` m away gets beside the level's own: a whole number, as a gain word can say
/// it.
std::uint32_t row_gain(double range, const Request& request, const Plan& plan, const Settings& settings);

/// Rows of the echogram, nearest first, each after its gain word where the request has them. `out` holds
/// exactly the image of the plan; the echogram has the plan's rows and beams.
void write_image(const Echogram& echogram, const Request& request, const Plan& plan, const Settings& settings,
                 std::span<std::uint8_t> out);

}  // namespace echoloop::oculus_device
