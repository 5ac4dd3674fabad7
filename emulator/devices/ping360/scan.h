// Where the head of a Ping360 goes in an automatic scan. Angles only, in gradians; no time and no messages.
#pragma once

#include "protocols/ping/messages.h"

namespace echoloop::ping360 {

inline constexpr int circle = 400;  ///< gradians

/// Full circles where start to stop spans 400 gradians, else to and fro between both.
class Scan {
  public:
    /// `twice`: the ends of a sector are pinged twice, once for each way.
    Scan(const ping::AutoTransmit& command, bool twice);

    /// 0..399
    int angle() const { return (start_ + offset_) % circle; }
    void advance();

  private:
    int start_, span_, step_;
    bool full_, twice_;
    int offset_ = 0, way_ = 1;
};

}  // namespace echoloop::ping360
