// What motors, supplies and other electronics of a vehicle leave in a receiver. Plain data and pure
// functions.
#pragma once

#include <span>
#include <vector>

#include "render/acoustics/ring_down.h"
#include "render/echogram.h"
#include "render/effects.h"

namespace echoloop {

/// Added to the echoes as noise of its own; what is given as a lift is relative to the receiver's noise, and
/// nothing where that is off.
struct Interference {
    double lines = 0;        ///< probability that a whole line is lifted
    double lift = 0;         ///< dB, mean
    double lift_spread = 0;  ///< dB, standard deviation
    double dashes = 0;       ///< mean number in each second of listening on one line; each has 1 to 3 bins
    double dash_level = 0;   ///< dB re 1 uPa, mean
    double dash_spread = 0;  ///< dB, standard deviation
    struct Stripe {
        double first = 0, last = 0;  ///< of all beams, 0 to 1
        double lift = 0;             ///< dB
    };
    std::vector<Stripe> stripes{};  ///< beams that are always lifted
};

/// The interference of a shot, for all its pings.
class InterferencePlan {
  public:
    InterferencePlan(const Shot& shot, Effects effects);
    /// Adds a line's own power in uPa^2. `noise_power`: uPa^2, mean of what is in `values` already.
    void add(const LineKey& line, double noise_power, std::span<float> values) const;

  private:
    double lift_of(const LineKey& line) const;
    void add_dashes(const LineKey& line, std::span<float> values) const;

    Interference rule_;
    bool any_ = false;
    double dashes_ = 0;  ///< mean number on one line
    double beams_ = 0;
};

}  // namespace echoloop
