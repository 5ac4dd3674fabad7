// Cuts a TCP stream into Oculus messages, and skips and counts everything else.
#pragma once

#include "protocols/oculus/codec.h"
#include "protocols/wire/framer.h"

namespace echoloop::oculus {

inline constexpr std::size_t host_payload = 73;  ///< the longest that a host sends: FireV2

/// Messages carry no checksum: one begins where a plausible header stands (known id, its version and size).
/// Where another one stands within a message without an image, bytes of the first were lost: it is skipped.
class MessageFinder {
  public:
    /// `longest`: of the payloads that may come; what claims more is noise.
    explicit MessageFinder(std::size_t longest = max_payload) : longest_(longest) {}

    wire::Found<Frame> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const;

  private:
    std::size_t longest_;
};

using Framer = wire::Framer<Frame, MessageFinder>;

}  // namespace echoloop::oculus
