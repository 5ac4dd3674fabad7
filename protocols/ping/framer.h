// Cuts a byte stream into frames of the Ping protocol, and skips and counts everything else.
#pragma once

#include "protocols/ping/messages.h"
#include "protocols/wire/framer.h"

namespace echoloop::ping {

inline constexpr std::size_t min_frame_bytes = 10;
/// The longest of all devices is an S500's chirp with 6000 results, 12076; other known hosts take 10250.
inline constexpr std::size_t max_frame_bytes = 12288;

/// A frame is accepted where "BR" stands, the length keeps within max_frame_bytes and the checksum is right.
/// Otherwise the search goes on at the byte behind this 'B', so no good frame is lost behind a bad length.
class FrameFinder {
  public:
    enum class Waiting {
        patient,    ///< the rest of a frame is waited for
        impatient,  ///< a whole frame behind half a frame means that the half is damaged: what a device
                    ///< needs, whose host says nothing more until it is answered
    };
    explicit FrameFinder(Waiting waiting = Waiting::patient) : waiting_(waiting) {}

    wire::Found<Frame> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {.with = 65536}; }

  private:
    Waiting waiting_;
};

using Framer = wire::Framer<Frame, FrameFinder>;

}  // namespace echoloop::ping
