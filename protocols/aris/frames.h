// Frames of an ARIS put together from the parts that come by UDP. Knows no transport.
#pragma once

#include <optional>

#include "protocols/aris/beams.h"
#include "protocols/aris/header.h"
#include "protocols/aris/messages.h"

namespace echoloop::aris {

struct WholeFrame {
    FrameHeader header;   ///< of a known ping mode, with at least one sample
    wire::Bytes samples;  ///< range after range, all beams of each
};

class FrameJoiner {
  public:
    /// The frame that this part completes. Frames that miss a part are lost.
    std::optional<WholeFrame> add(const FramePart& part);
    /// Forgets what waits for more parts.
    void drop();
    std::uint64_t lost() const { return lost_; }

  private:
    FrameHeader header_;
    std::uint32_t number_ = 0;
    wire::Bytes data_;
    std::uint64_t lost_ = 0;
};

}  // namespace echoloop::aris
