// What a receiver hears of its own pulse before the water answers: the transmitter's breakthrough, the
// transducer that rings on, and echoes of what carries the sonar. Plain data and pure functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/echogram.h"
#include "render/effects.h"

namespace echoloop {

/// A curve over time, straight in dB between its points. Nothing is heard before the first one and after the
/// last one.
struct RingDown {
    struct Point {
        double time = 0;     ///< s after the transmission began, ascending
        double level = 0;    ///< dB re the source level
        double scatter = 0;  ///< dB, standard deviation from ping to ping
        double lasting = 0;  ///< dB, standard deviation over bearing, the same at every ping
    };
    std::vector<Point> points;
    double pulse = 0;  ///< s: with a longer one the curve comes as much later
    /// What `lasting` is multiplied by at bearings evenly all round, the first astern, clockwise; empty:
    /// random numbers, of one unit always the same.
    std::vector<double> bearings{};
};

/// One line (a beam of one ping) among all others.
struct LineKey {
    std::uint64_t key = 0, ping = 0;
    std::uint32_t beam = 0;
    double bearing = 0;  ///< rad, relative to the sonar, not to its head
};

/// The curve of a shot, for all its pings.
class RingDownPlan {
  public:
    RingDownPlan(const Shot& shot, Effects effects);
    /// Adds a line's own power in uPa^2. `source_level` in dB re 1 uPa at 1 m.
    void add(const LineKey& line, double source_level, std::span<float> values) const;

  private:
    std::vector<float> level_, scatter_, lasting_;  ///< dB, of each bin that is reached
    std::size_t first_ = 0;                         ///< bin of the first of them
    std::vector<double> bearings_;
    double cell_ = 1;  ///< rad, from one number of the scatter to the next
};

}  // namespace echoloop
