// Somebody who looks at a run while it goes, such as a page in a browser. Nothing of it comes back to a
// device.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/contract/device.h"
#include "render/motion.h"

namespace echoloop {

/// A ping that a device hears now.
struct SeenPing {
    std::string_view device;
    std::uint64_t number = 0;
    Time transmitted{};        ///< run time
    Time late{};               ///< after it was due
    Time drawn{}, due{};       ///< since the transmission: when the echogram was there, and was due
    const Echogram& echogram;  ///< with all that the device hears, and its objects where they were wanted
    const std::vector<Pose>& movers;    ///< Situation::movers
    double unix_time = 0;               ///< s since 1970, of the transmission
    Pose world_from_body{};             ///< of the vehicle, then
    Motion body{}, sonar{};             ///< in the world
    std::vector<std::string> faults{};  ///< kinds and numbers of those that are on
};

/// Bytes that have passed over the wire of a port.
struct SeenBytes {
    std::string_view device, port;
    bool sent = false;     ///< by the device
    bool packets = false;  ///< datagrams, each whole
    ByteView bytes;
    double line_rate = 0;  ///< bit/s, of a serial line; 0: of no line, or as fast as the other end takes it
    double unix_time = 0;  ///< s since 1970, by the clock of the run or the capture; 0: now
};

/// A fault that was made, or has ended.
struct SeenFault {
    std::string_view device, port;  ///< port: "" for the whole device
    double unix_time = 0;
    std::string text;  ///< "bit_flips: byte 17, bit 3"
    bool on_message =
        false;          ///< bytes that it has touched pass at that time, those of a message that is there
    bool sent = false;  ///< by the device, those bytes
};

/// What somebody wants of a ping; each holds the one before it.
enum class Wanted {
    nothing,
    levels,
    objects,  ///< Echogram::objects as well, which are drawn for who asks only and take time
};

class Watch {
  public:
    Watch() = default;
    virtual ~Watch() = default;
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

    /// Asked when a ping is sent: is ping() to be called with it, and with what? On the thread of the wires.
    virtual Wanted wants_ping(std::string_view device, const Shot& shot) = 0;
    /// On the thread of the wires or of a device; it copies what it needs and returns.
    virtual void ping(const SeenPing& ping) = 0;
    /// On the thread of the wires, as above.
    virtual void bytes(const SeenBytes& bytes) = 0;
    /// The same.
    virtual void fault(const SeenFault&) {}
};

}  // namespace echoloop
