// Received levels to the 8-bit samples of a Ping360: gain, time-varied gain. Pure functions.
#pragma once

#include <cstdint>
#include <vector>

#include "emulator/devices/ping360/settings.h"
#include "render/echogram.h"

namespace echoloop::ping360 {

/// 0..255, one per bin of the echogram's only beam. `gain` is 0, 1 or 2.
std::vector<std::uint8_t> samples_8bit(const Echogram& echogram, const Settings& settings, std::uint8_t gain);

}  // namespace echoloop::ping360
