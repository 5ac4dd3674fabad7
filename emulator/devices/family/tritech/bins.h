// Received levels to the bins of mtHeadData: gain, TVG, 8-bit or packed 4-bit. Pure functions.
#pragma once

#include <cstdint>
#include <vector>

#include "emulator/devices/family/tritech/acoustics.h"
#include "render/echogram.h"

namespace echoloop::tritech {

/// dB of the whole scale of a count.
inline constexpr double full_scale_db = 80;

/// dB on the scale of 0..80 dB of one bin of the echogram's only beam, at `gain_db`.
double shown_db(const Echogram& echogram, std::size_t bin, const Acoustics& acoustics, const Tuning& tuning,
                double gain_db);

/// 0..255 on the scale of 0..80 dB in steps of half a decibel, one per bin of the echogram's only beam; the
/// first two are 0. `gain` is 0..210 for 0..80 dB.
std::vector<std::uint8_t> levels_8bit(const Echogram& echogram, const Acoustics& acoustics,
                                      const Tuning& tuning, std::uint8_t gain);

/// How 4-bit bins are packed.
struct Packing {
    bool high_first = true;   ///< the high half of a byte is the nearer bin
    bool span_of_15 = false;  ///< ADSpan and ADLow are on the 0..15 scale
};

/// 0..15 over ADLow .. ADLow + ADSpan, two bins a byte; an odd last bin is padded with 0.
std::vector<std::uint8_t> pack_4bit(const std::vector<std::uint8_t>& levels, const Packing& packing,
                                    std::uint8_t ad_low, std::uint8_t ad_span);

}  // namespace echoloop::tritech
