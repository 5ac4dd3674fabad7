// From the echo of an S500 to its depth, and the depths of many pings to a smooth one. Knows no wire format.
#pragma once

#include <cstdint>
#include <deque>

#include "emulator/devices/s500/settings.h"
#include "render/echogram.h"

namespace echoloop::s500 {

struct Depth {
    double metres = 0;      ///< by the speed of sound that the host has set; 0: nothing heard
    double confidence = 0;  ///< %
};

/// The leading edge of the strongest echo. Its confidence grows from 0 at 10 dB above the noise, as the
/// loudest of a thousand noise samples may be, to 100 % at 25 dB.
Depth find_depth(const Echogram& echogram, const State& state, const Settings& settings);

/// The last 20 pings: their mean depth, without those that heard nothing, and their mean confidence.
class SmoothDepth {
  public:
    void add(const Depth& depth);
    Depth mean() const;

  private:
    std::deque<Depth> last_;
};

}  // namespace echoloop::s500
