// The time that devices live in. Never goes backwards; knows no device.
#pragma once

#include <chrono>

#include "emulator/device.h"

namespace echoloop {

/// Run time on the steady clock, optionally faster or slower: `rate` seconds of the run pass in one real
/// second.
class Clock {
  public:
    using Steady = std::chrono::steady_clock;

    explicit Clock(double rate = 1.0, Steady::time_point start = Steady::now())
        : start_(start), rate_(rate) {}

    Time now() const { return at(Steady::now()); }
    /// Run time that corresponds to an instant of the steady clock.
    Time at(Steady::time_point instant) const {
        const std::chrono::duration<double, std::nano> real = instant - start_;
        return Time(static_cast<Time::rep>(real.count() * rate_));
    }
    /// Instant of the steady clock at which run time `t` comes.
    Steady::time_point when(Time t) const {
        const std::chrono::duration<double, std::nano> real(static_cast<double>(t.count()) / rate_);
        return start_ + std::chrono::duration_cast<Steady::duration>(real);
    }
    double rate() const { return rate_; }

  private:
    Steady::time_point start_;
    double rate_;
};

}  // namespace echoloop
