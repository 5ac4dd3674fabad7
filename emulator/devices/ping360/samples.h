// Received levels to the 8-bit samples of a Ping360: gain, time-varied gain, ring-down. Pure functions.
#pragma once

#include <cstdint>
#include <vector>

#include "emulator/devices/ping360/settings.h"
#include "render/echogram.h"

namespace echoloop::ping360 {

/// 0..255, one per bin of the echogram's only beam. `gain` is 0, 1 or 2.
std::vector<std::uint8_t> samples_8bit(const Echogram& echogram, const Settings& settings, std::uint8_t gain);

/// 0..255 of the transmitter's own sound, `t` s after the transmission began; 0 if it is switched off.
double ring_down(double t, const RingDown& ring);

}  // namespace echoloop::ping360
