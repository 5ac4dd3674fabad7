// The receiver of an emulated device, the Micron's, as the checks of gain and noise look through it.
#pragma once

#include <cmath>
#include <vector>

#include "emulator/devices/family/tritech/bins.h"

namespace echoloop::validation {

inline constexpr double micron_full_scale = tritech::full_scale_db;  ///< dB, 255 counts

/// dB above `reference` as the device shows each bin of the only beam, in its steps of 0.31 dB, after a
/// time-varied gain of `spreading` dB per decade of range and `absorption` dB/m one way.
inline std::vector<double> shown_by_micron(const Echogram& echogram, double spreading, double absorption,
                                           double reference) {
    tritech::Acoustics acoustics;
    acoustics.tvg_spreading = spreading;
    acoustics.band.absorption = absorption;
    acoustics.reference_level = reference;
    std::vector<double> shown;
    for (const std::uint8_t count : tritech::levels_8bit(echogram, acoustics, {acoustics.band}, 0))
        shown.push_back(count * micron_full_scale / 255);
    return shown;
}

}  // namespace echoloop::validation
