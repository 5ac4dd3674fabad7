// Where the head of an 881A points next: all around, to and fro in a sector, or towards a sector that it has
// left. Whole positions of 0.3 deg only; knows no time.
#pragma once

#include "protocols/imagenex/messages.h"

namespace echoloop::imagenex881a {

inline constexpr int circle = 1200;  ///< positions
inline constexpr int ahead = 600;

class Scan {
  public:
    /// `clip`: the last step of a sector ends on its edge; else the head turns before it would pass the edge.
    Scan(int position, bool clip) : position_(position), clip_(clip) {}

    /// Does what a command wants before its ping; returns the positions travelled.
    int move(const imagenex::SwitchCommand& command);

    int position() const { return position_; }  ///< 0..1199, 600 is 0 deg
    bool clockwise() const { return clockwise_; }

  private:
    int next_in_sector(int offset, int half, int step);
    int enter_sector(int offset, int half, int step);

    int position_;
    bool clip_;
    bool clockwise_ = true;
    bool reversed_ = false;  ///< bit of the command before
};

}  // namespace echoloop::imagenex881a
