// Cuts a byte stream into SeaNet frames, and skips and counts everything else.
#pragma once

#include "protocols/seanet/messages.h"
#include "protocols/wire/framer.h"

namespace echoloop::seanet {

inline constexpr std::size_t min_frame_bytes = 14;
inline constexpr std::size_t max_frame_bytes = 4096;

/// A frame is accepted where both length forms agree, lie within 14..4096 bytes in all, and LF stands where
/// they say. Otherwise the search goes on at the byte behind this '@', so no good frame is lost behind a bad
/// length.
class FrameFinder {
  public:
    enum class Lengths {
        trusted,  ///< the length decides
        by_id,    ///< commands without payload are also taken at their known 14 bytes, whatever length they
                  ///< claim
    };
    explicit FrameFinder(Lengths lengths = Lengths::trusted) : lengths_(lengths) {}

    wire::Found<Frame> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {.with = 65536}; }

  private:
    Lengths lengths_;
};

using Framer = wire::Framer<Frame, FrameFinder>;

}  // namespace echoloop::seanet
