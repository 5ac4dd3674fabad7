// The side-scan packets of an .xtf as messages of JSF, the only side-scan protocol of two sides that this
// knows: one for each channel. Takes any bytes.
#pragma once

#include <array>

#include "tools/capture/capture.h"

namespace echoloop::capture {

inline constexpr std::size_t xtf_ping_header = 256;  ///< B at the start of a packet with a ping

class XtfSides {
  public:
    /// `header`: the first 1024 bytes of the file.
    explicit XtfSides(ByteView header);

    /// Whether the file says that it holds a side-scan and no bathymetry.
    bool any() const { return any_; }
    /// Of one whole packet of type 0, taken at `time`, s since 1970. Channels that are neither port nor
    /// starboard are left out, and what does not fit its packet.
    std::vector<Bytes> messages(ByteView packet, double time) const;

  private:
    struct Channel {
        std::uint8_t type = 0;         ///< 1 port, 2 starboard
        std::size_t sample_bytes = 0;  ///< 1, 2 or 4
        bool floating = false, signs = false;
        double frequency = 0;  ///< Hz
    };

    std::array<Channel, 6> channels_;
    std::size_t count_ = 0;
    bool any_ = false;
};

}  // namespace echoloop::capture
