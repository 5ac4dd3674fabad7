// When a sonar that pings by itself sends the next ping: one at a time, not sooner than the host's interval.
// Sets no timer of its own; the device wakes at wake().
#pragma once

#include <algorithm>

#include "emulator/contract/device.h"

namespace echoloop {

class PingPacer {
  public:
    /// Pings from now on, behind the one under way, and `interval` behind the last one.
    void start(Time now, Time interval) {
        wanted_ = true;
        if (!under_way_) next_ = std::max(now, after_last(interval));
    }
    /// No more pings; the one under way is not heard.
    void stop() {
        wanted_ = under_way_ = false;
        next_ = Time::max();
    }
    /// True if a ping goes out now; end() must follow.
    bool begin(Time now) {
        if (under_way_ || now < next_) return false;
        began_ = next_;  // as planned, so that late wake-ups do not add up
        next_ = Time::max();
        under_way_ = any_ = true;
        return true;
    }
    /// The ping was heard, and the next one follows if one is wanted. False if it was given up.
    bool end(Time now, Time interval) {
        if (!under_way_) return false;
        under_way_ = false;
        ended_ = now;
        next_ = wanted_ ? after_last(interval) : Time::max();
        return true;
    }
    /// After the ping under way, no other.
    void once() { wanted_ = false; }

    Time wake() const { return next_; }
    bool under_way() const { return under_way_; }

  private:
    Time after_last(Time interval) const { return any_ ? std::max(began_ + interval, ended_) : Time{}; }

    bool wanted_ = false, under_way_ = false;
    bool any_ = false;
    Time next_ = Time::max(), began_{}, ended_{};
};

}  // namespace echoloop
