// Somebody who looks at a run while it goes, such as a page in a browser. Nothing of it comes back to a
// device.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/contract/device.h"

namespace echoloop {

/// A ping that a device hears now.
struct SeenPing {
    std::string_view device;
    std::uint64_t number = 0;
    Time transmitted{};               ///< run time
    Time late{};                      ///< after it was due
    Time drawn{}, due{};              ///< since the transmission: when the echogram was there, and was due
    const Echogram& echogram;         ///< with its objects and all that the device hears
    const std::vector<Pose>& movers;  ///< Situation::movers
};

/// Bytes that have passed over the wire of a port.
struct SeenBytes {
    std::string_view device, port;
    bool sent = false;     ///< by the device
    bool packets = false;  ///< datagrams, each whole
    ByteView bytes;
    double line_rate = 0;  ///< bit/s, of a serial line; 0: of no line, or as fast as the other end takes it
    double unix_time = 0;  ///< s since 1970, of what is no longer new; 0: now
};

class Watch {
  public:
    Watch() = default;
    virtual ~Watch() = default;
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

    /// Asked when a ping is sent: is ping() to be called with it? On the thread of the wires.
    virtual bool wants_ping(std::string_view device, const Shot& shot) = 0;
    /// On the thread of the wires or of a device; it copies what it needs and returns.
    virtual void ping(const SeenPing& ping) = 0;
    /// On the thread of the wires, as above.
    virtual void bytes(const SeenBytes& bytes) = 0;
};

}  // namespace echoloop
