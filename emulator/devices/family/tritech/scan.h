// Where a scanning head points next: full circle or sector, direction, limits and sweep codes. Pure
// arithmetic in 1/16 gradian (6400 a circle, 3200 ahead, clockwise positive seen from above); knows no time
// and no message.
#pragma once

#include <cstdint>

#include "protocols/seanet/constants.h"

namespace echoloop::tritech {

/// How the head treats what the specification leaves open.
struct ScanRules {
    bool force_right = false;        ///< continuous scans turn clockwise whatever the command says
    bool limits_twice = false;       ///< ping each limit twice per pass
    bool whole_steps = false;        ///< never cut the last step of a sector at its limit
    bool start_at_position = false;  ///< a new sector begins where the head points, not at its left limit
};

struct ScanCommand {
    bool continuous = true;
    bool clockwise = true;
    bool stare = false;  ///< hold the left limit
    bool motor_off = false;
    std::uint16_t left_limit = 0, right_limit = 0;  ///< any value; taken modulo 6400
    std::uint8_t step = 32;                         ///< 0 does not move
};

class Scan {
  public:
    explicit Scan(ScanRules rules = {}) : rules_(rules) {}

    /// New parameters: a sector starts at its left limit moving clockwise.
    void configure(const ScanCommand& command);
    /// mtHeadCommand 0x0F: turn round at once.
    void reverse();
    /// Re-centred: points ahead.
    void centre() { position_ = 3200; }
    /// Move on after a ping. In a sector the head turns round at the limits.
    void advance();

    std::uint16_t position() const { return position_; }
    bool clockwise() const { return clockwise_; }
    seanet::SweepCode sweep_code() const;
    /// Step that the motor has to make for the next ping, 1/16 gradian; 0 if it holds still.
    std::uint16_t step() const;

  private:
    std::uint16_t sector_width() const;
    std::uint16_t offset_from_left() const;
    std::uint16_t last_offset() const;
    bool full_circle() const;
    void advance_in_sector();

    ScanRules rules_;
    ScanCommand command_;
    std::uint16_t position_ = 3200;
    bool clockwise_ = true;
    bool pinged_limit_ = false;  ///< the limit under the head has had its first of two pings
};

}  // namespace echoloop::tritech
