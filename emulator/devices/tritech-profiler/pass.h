// The pings of one pass of a profiler from limit to limit, in 1/16 gradian (6400 a circle, 3200 ahead,
// clockwise positive). Pure arithmetic.
#pragma once

#include <cstdint>

#include "protocols/seanet/constants.h"

namespace echoloop::profiler {

struct PassRules {
    bool alternate = false;    ///< the next pass runs the other way
    bool clockwise = false;    ///< the first one; without `alternate` all of them
    bool stare = false;        ///< every ping at the left limit
    bool whole_steps = false;  ///< no shorter last step at a limit
};

class Pass {
  public:
    Pass() = default;
    /// `left` and `right`: any value, taken modulo 6400; equal limits are a full circle. `step` 0 holds
    /// still.
    Pass(std::uint16_t left, std::uint16_t right, std::uint8_t step, const PassRules& rules);

    /// Pings of a pass, 1..most_pings.
    std::size_t pings() const { return pings_; }
    std::uint16_t bearing(std::size_t ping) const;
    bool clockwise() const { return clockwise_; }
    /// Way of the motor to ping `ping` from the one before it, 1/16 gradian; the first ping of a pass comes
    /// from the end of the last one.
    std::uint16_t way_to(std::size_t ping) const;
    /// The pass is over; the next one begins.
    void turn();

    static constexpr std::size_t most_pings = 2022;  ///< as many as a frame of 4096 bytes holds

  private:
    std::uint16_t offset(std::size_t ping) const;

    PassRules rules_;
    std::uint16_t left_ = 0, width_ = 0;
    std::uint8_t step_ = 0;
    std::size_t pings_ = 1;
    bool clockwise_ = true, began_ = false;
};

}  // namespace echoloop::profiler
