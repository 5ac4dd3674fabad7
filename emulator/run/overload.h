// What one sonar's pings are spared while rendering does not keep up, so that more of them come. Knows no
// clock and renders nothing.
#pragma once

#include <algorithm>
#include <chrono>

#include "emulator/contract/device.h"

namespace echoloop {

/// The rule: after five pings in a row that waited for their rendering for more than 20 ms beyond their time,
/// the late echoes of the ping before are left out; after five more, a ping is drawn with a quarter of the
/// pixels. A ping that waited for more than 200 ms counts for three: two of them are enough, since many
/// sonars at once take seconds for five. Both come back, one after the other, each after 32 pings in a row
/// that waited less; after twice as many every time that it was too early, 1024 at most. No ping is left out:
/// a driver may wait for it. The figures are our own choice.
class Overload {
  public:
    bool late_echoes() const { return spared_ < 1; }
    /// Factor on the number of pixels.
    double density() const { return spared_ < most ? 1 : 0.25; }

    /// `waited`: for the rendering of a ping that was heard, beyond its time.
    void heard(Time waited) {
        constexpr int patience = 5, longest_trial = 1024;  // pings
        constexpr Time too_long = std::chrono::milliseconds(20), far_too_long = 10 * too_long;
        waited > too_long ? (behind_ += waited > far_too_long ? 3 : 1, in_time_ = 0)
                          : (++in_time_, behind_ = 0);
        if (behind_ >= patience && spared_ < most) {
            if (spared_ < given_back_) trial_ = std::min(2 * trial_, longest_trial);
            ++spared_, behind_ = 0;
            given_back_ = std::max(given_back_, spared_);
        }
        if (in_time_ >= trial_ && spared_ > 0) --spared_, in_time_ = 0;
    }

  private:
    static constexpr int most = 2;

    int spared_ = 0;      ///< 1: late echoes, 2: pixels, too
    int given_back_ = 0;  ///< how far it ever went: to get there again means that it came back too early
    int behind_ = 0, in_time_ = 0;  ///< pings in a row, some of the first kind counted thrice
    int trial_ = 32;                ///< pings
};

}  // namespace echoloop
