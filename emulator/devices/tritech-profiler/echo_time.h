// From the echogram of a profiler's ping to the one echo time that it reports. Pure functions.
#pragma once

#include <cstdint>

#include "emulator/devices/family/tritech/acoustics.h"
#include "render/echogram.h"

namespace echoloop::profiler {

/// Which of the echoes above the threshold counts.
enum class Choice {
    first,      ///< the first one
    strongest,  ///< the middle of the strongest one
    normal,     ///< the leading edge of the strongest one
};

struct EchoRule {
    Choice choice = Choice::normal;
    double threshold = 0;  ///< dB on the scale of 0..80 dB
    double lockout = 0;    ///< s; nothing earlier counts
    double gain = 0;       ///< dB
};

struct Echo {
    std::uint16_t time = 0;  ///< us, two-way; 0: none
    double peak = 0;         ///< dB on the scale of 0..80 dB, of the strongest bin behind the lockout
};

Echo find_echo(const Echogram& echogram, const EchoRule& rule, const tritech::Acoustics& acoustics,
               const tritech::Tuning& tuning);

}  // namespace echoloop::profiler
