// Where a scanning head points next: all around, to and fro in a sector, or towards a sector that it has
// left. Whole positions of 0.3 deg only; knows no time.
#pragma once

#include <numbers>

#include "protocols/imagenex/messages.h"

namespace echoloop::imagenex_head {

inline constexpr int circle = 1200;  ///< positions
inline constexpr int ahead = 600;

/// rad clockwise from ahead
constexpr double angle_of(int position) { return (position - ahead) * 2 * std::numbers::pi / circle; }

/// What bit 6 of byte 5 means.
enum class ReverseBit {
    direction,  ///< all around, as long as it is set the head turns counter-clockwise; a change turns a
                ///< sector
    once        ///< where it comes up, the head turns round
};

class Scan {
  public:
    /// `clip`: the last step of a sector ends on its edge; else the head turns before it would pass the edge.
    Scan(int position, bool clip, ReverseBit bit = ReverseBit::direction)
        : position_(position), clip_(clip), bit_(bit) {}

    /// Does what a command wants before its ping; returns the positions travelled.
    int move(const imagenex::SwitchCommand& command);

    int position() const { return position_; }  ///< 0..1199, 600 is 0 deg
    bool clockwise() const { return clockwise_; }

  private:
    int next_in_sector(int offset, int half, int step);
    int enter_sector(int offset, int half, int step);
    void set_direction(bool reversed, bool around);

    int position_;
    bool clip_;
    ReverseBit bit_;
    bool clockwise_ = true;
    bool reversed_ = false;  ///< bit of the command before
};

}  // namespace echoloop::imagenex_head
