// Where the head of a Ping360 goes in an automatic scan. Angles only, in gradians; no time and no messages.
#pragma once

#include "protocols/ping/messages.h"

namespace echoloop::ping360 {

inline constexpr int circle = 400;  ///< gradians

/// Full circles where start to stop spans 400 gradians; to and fro between both in a sector of at most half a
/// circle; in a wider one always the same way, and back from its end to its start. The last step before an
/// end is shortened. Steps of 128 to 255 are negative, -128 to -1, and go from start to stop the other way
/// round.
class Scan {
  public:
    /// `twice`: the ends of a sector are pinged twice, once for each way.
    Scan(const ping::AutoTransmit& command, bool twice);

    /// 0..399
    int angle() const { return (start_ + sense_ * offset_ + circle) % circle; }
    /// Gradians from ping to ping, at least 1.
    int step() const { return step_; }
    void advance();

  private:
    int sense_;  ///< 1: angles rise from start to stop; -1: they fall
    int start_, span_, step_;
    bool full_, twice_;
    int offset_ = 0, way_ = 1;
};

}  // namespace echoloop::ping360
