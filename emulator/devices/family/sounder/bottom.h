// Finds the bottom in the echo of a single beam, as any echosounder does. Pure functions; knows no device.
#pragma once

#include <cstddef>
#include <optional>

#include "render/echogram.h"

namespace echoloop::echosounder {

/// How a sounder looks for the bottom. What spreading and absorption take is given back before echoes are
/// compared; 20 dB per decade is what the echo of a flat bottom loses.
struct BottomRule {
    double blanking = 0;    ///< s, two-way time; bins that begin earlier do not count
    double margin = 15;     ///< dB above the noise, from where a bin may be an echo; -inf: every bin may
    double edge = 10;       ///< dB below the strongest echo, where its leading edge counts
    double spreading = 20;  ///< dB per decade of time
    double absorption = 0;  ///< dB per s of two-way time
};

struct Bottom {
    std::size_t bin = 0;     ///< of the leading edge
    double above_noise = 0;  ///< dB, of the strongest bin; +inf where there is no noise
};

/// The first bin within `edge` of the strongest one among those that may be echoes; nothing if there are
/// none, or the strongest is the water's own (water.h; not asked where every bin may be an echo). In a wide
/// beam over a slope that is the nearest bottom, not the one on the axis, as with a real sounder.
std::optional<Bottom> find_bottom(const Echogram& echogram, const BottomRule& rule, std::size_t beam = 0);

/// Mean power of the noise in a beam: the receiver's own, or the background of the beam's quieter quarter,
/// where reverberation is stronger than that.
double background(const Echogram& echogram, std::size_t beam = 0);

/// Two-way time in s at the beginning of a bin; half a bin more is its middle.
inline double bin_time(const Shot& shot, double bin) { return shot.first_bin_time + bin * shot.bin_interval; }

}  // namespace echoloop::echosounder
