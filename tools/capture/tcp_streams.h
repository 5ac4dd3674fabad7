// The bytes of TCP connections in their order, out of captured segments: what came twice is dropped, what
// came early waits. Bounded memory whatever the capture holds.
#pragma once

#include <functional>
#include <map>

#include "tools/capture/packet.h"

namespace echoloop::capture {

class TcpStreams {
  public:
    /// Calls `each` with bytes that come next in their direction; `gap`: the capture lacks bytes before them.
    using Each = std::function<void(Address from, Address to, ByteView bytes, bool gap)>;
    void add(const TcpSegment& segment, const Each& each);
    /// Gives out what still waits behind a gap.
    void finish(const Each& each);

  private:
    using Way = std::pair<Address, Address>;
    struct Stream {
        bool begun = false;
        std::uint32_t next = 0;
        std::map<std::uint32_t, Bytes> early;  ///< by sequence number
        std::size_t waiting = 0;               ///< bytes of memory for `early`
    };

    static void give_out(const Way& way, Stream& stream, const Each& each, bool over_gaps);

    std::map<Way, Stream> streams_;
};

}  // namespace echoloop::capture
