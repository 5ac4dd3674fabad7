// What plays a capture: it says which bytes go to which port and when. Pure logic of messages and times; it
// holds no clock, opens nothing, and knows no address, so that nothing can go where the capture came from.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "emulator/contract/device.h"
#include "emulator/replay/command.h"

namespace echoloop::replay {

/// What one side said on one of the ports that are played.
struct Said {
    Time time{};  ///< since the beginning of what is played; never decreases
    std::size_t port = 0;
    bool by_device = true;  ///< by the side that is played; else by its driver
    Bytes bytes;
    std::string name{};  ///< of the message, where it is a whole one; "" otherwise
    Command command{};   ///< what a driver asks for, where messages are whole
};

/// The capture, from its first message on.
class Source {
  public:
    Source() = default;
    virtual ~Source() = default;
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    virtual std::optional<Said> next() = 0;
    virtual void rewind() = 0;

    /// What the device says next; what its driver said is passed over.
    std::optional<Said> next_of_device() {
        auto said = next();
        while (said && !said->by_device) said = next();
        return said;
    }
};

/// Bytes for a port.
struct Outgoing {
    std::size_t port = 0;
    Bytes bytes;
};

struct PlayerCounts {
    std::uint64_t requests = 0;                       ///< of the driver, understood
    std::uint64_t answered = 0;                       ///< by captured answers
    std::map<std::string, std::uint64_t> unanswered;  ///< requests that the capture does not hold, by name
    std::uint64_t noise = 0;                          ///< bytes from the driver that are no message
    std::uint64_t laps = 0;                           ///< times that the end of the capture was reached
};

class Player {
  public:
    Player() = default;
    virtual ~Player() = default;
    Player(const Player&) = delete;
    Player& operator=(const Player&) = delete;

    /// A driver may listen now; only the first call begins something.
    virtual void arrived(Time now) = 0;
    /// The driver said something on a port.
    virtual void heard(std::size_t port, ByteView bytes, Time now) = 0;
    /// Another driver is on this port: half a request of the last one is worthless.
    virtual void reconnected(std::size_t port) = 0;
    /// A person asked for the next message.
    virtual void stepped(Time now) = 0;

    /// When the next bytes are to go; empty: not before something happens.
    virtual std::optional<Time> due() const = 0;
    /// The bytes that are due.
    virtual Outgoing take() = 0;
    /// True if nothing will ever come again.
    virtual bool ended() const = 0;
    virtual const PlayerCounts& counts() const = 0;
};

}  // namespace echoloop::replay
