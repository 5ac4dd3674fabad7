// The objects that a sonar has before it, drawn by bearing and range. Draws no text and knows no middleware.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "tools/poses/truth/ping.h"

namespace echoloop::poses {

struct RgbPicture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> bytes;  ///< rgb8, row by row, the first at the top
};

/// The colour of an object: bright, and far from that of its neighbours' numbers; 0 is black.
std::array<std::uint8_t, 3> object_color(std::uint32_t object);

/// What one sonar has before it. A ping of many beams takes the place of the one before; beams of a head stay
/// until it looks there again.
class TruthPicture {
  public:
    void add(TruthPing ping);
    /// As wide as high, the sonar in the middle, forward up, the longest range at the edges; of a sector that
    /// looks ahead the upper half. Of rows of beams the middle one.
    RgbPicture draw(int width) const;

  private:
    struct Beam {
        TruthBeam beam;
        double width, first_range, bin_size, range;
    };
    std::uint32_t object_at(double bearing, double range) const;

    std::map<long, Beam> beams_;  ///< by bearing in steps
};

}  // namespace echoloop::poses
