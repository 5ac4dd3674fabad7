// Received levels to the bins of mtHeadData: gain, TVG, 8-bit or packed 4-bit. Pure functions.
#pragma once

#include <cstdint>
#include <vector>

#include "emulator/devices/tritech-micron/settings.h"
#include "render/echogram.h"

namespace echoloop::micron {

/// 0..255 on the scale of 0..80 dB, one per bin of the echogram's only beam. `gain` is 0..210 for 0..80 dB.
std::vector<std::uint8_t> levels_8bit(const Echogram& echogram, const Settings& settings, std::uint8_t gain);

/// 0..15 over ADLow .. ADLow + ADSpan, two bins a byte; an odd last bin is padded with 0.
std::vector<std::uint8_t> pack_4bit(const std::vector<std::uint8_t>& levels, const Settings& settings,
                                    std::uint8_t ad_low, std::uint8_t ad_span);

}  // namespace echoloop::micron
