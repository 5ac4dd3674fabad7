// A sonar as its driver sees it: a pure state machine of bytes, echoes and time. It never sleeps, holds no
// clock, opens no socket and draws no random numbers of its own. One Session joins it to the world.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/echogram.h"
#include "render/motion.h"

namespace echoloop {

/// Time since the start of the run, on the session's clock.
using Time = std::chrono::nanoseconds;
using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

inline Time from_seconds(double s) { return Time(static_cast<std::int64_t>(s * 1e9)); }
inline double to_seconds(Time t) { return static_cast<double>(t.count()) * 1e-9; }

/// An IPv4 address and port in host byte order; zero for a byte stream, which has one other end only.
struct Address {
    std::uint32_t ip = 0;
    std::uint16_t port = 0;
    friend auto operator<=>(const Address&, const Address&) = default;
};

/// 127.0.0.0/8, an IPv4 address in host byte order.
constexpr bool is_loopback(std::uint32_t ip) { return ip >> 24 == 127; }

/// Bytes to send on port `port` of ports(); a datagram is one element. `to` is for datagram ports, and for
/// ports of several drivers: one of them, or zero for all who are connected.
struct Send {
    std::size_t port = 0;
    Bytes bytes;
    Address to;
    Time not_before{};     ///< paces the datagrams of one big frame; the past means now
    bool hang_up = false;  ///< stream ports: the connection is closed behind these bytes, if it is one
    double line_rate = 0;  ///< serial lines: bit/s of these bytes; 0: the line's own
};

/// A ping to render. The Session hands the echogram back through heard() at `due`, never earlier:
/// transmit + 2R/c + motor + processing. If rendering takes longer the ping is late, and is counted so.
struct Ping {
    Shot shot;
    Time due{};
};

/// Where the device is at a moment, and how it moves: what a motion sensor in it would feel.
struct Located {
    Time time{};
    Pose world_from_device;
    Motion motion;  ///< velocity in the world, turning about the device's axes
};

struct Actions {
    std::vector<Send> send;
    std::optional<Ping> ping;
    std::optional<Time> wake;  ///< replaces the pending wake-up; nullopt leaves it as it is
    /// Moments, none of them later than now, at which it wants to know where it was: located() follows at
    /// once. Those of a second ago are surer than those of now, where poses come from outside.
    std::vector<Time> locate{};
};

/// What arrived on a port, and from whom: zero for a stream that has one driver only.
struct Received {
    std::size_t port = 0;
    ByteView bytes;
    Address from;
};

/// One place where the device meets the wire.
struct Port {
    enum class Kind { stream, datagram };
    std::string name;  ///< e.g. "line", "commands", "discovery"
    Kind kind = Kind::stream;
    Address bind;             ///< datagram: where the device listens; port 0 lets the system choose
    bool shared = false;      ///< datagram: several programs may listen there (discovery broadcasts)
    std::size_t drivers = 1;  ///< stream that listens by TCP: how many may be connected at once
    /// Several drivers: one that does not read holds up the whole device. Else it misses what does not fit
    /// the memory that is kept for it.
    bool slow_holds_up = false;
    /// Stream that listens by TCP: messages that are kept for a driver that does not read, beside the one
    /// that it is being sent; it misses the others and holds nothing up. 0: as it is with that memory.
    std::size_t messages_kept = 0;
    /// Several drivers: one that has said its last word and closed its direction only is still there for half
    /// a second, until it is hung up on.
    bool answers_half_closed = false;
    /// Stream that listens by TCP: it serves web browsers, and looks itself at whose page asks.
    bool speaks_http = false;
    /// Stream: its place among the device's endpoints; none: behind that of the stream before.
    std::optional<std::size_t> endpoint{};
};

/// Figures of what went wrong on the wire, printed at the end of a run.
struct DeviceCounters {
    std::uint64_t messages = 0;  ///< understood
    std::uint64_t rejected = 0;  ///< framed but not understood, or refused
    std::uint64_t skipped_bytes = 0;
    std::uint64_t pings = 0;
};

class Device {
  public:
    virtual ~Device() = default;
    Device() = default;
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    virtual std::vector<Port> ports() const = 0;
    /// Power on; the first actions (a first alive, a first status).
    virtual Actions started(Time now) = 0;
    virtual Actions received(const Received& data, Time now) = 0;
    virtual Actions heard(const Echogram& echogram, Time now) = 0;
    virtual Actions woken(Time now) = 0;
    /// What Actions::locate asked for, in its order.
    virtual Actions located(std::span<const Located> /*places*/, Time /*now*/) { return {}; }
    /// Another driver is at the other end of a stream port: half a frame of the last one is worthless. Never
    /// called for ports of several drivers.
    virtual void reconnected(std::size_t port) = 0;
    /// After reconnected(), where the stream is a connection: who is at the other end of it. Where there may
    /// be several, `peer` tells them apart, in what they say as well, until it is disconnected.
    virtual Actions connected(std::size_t /*port*/, Address /*peer*/, Time /*now*/) { return {}; }
    /// It is not there any more. A serial line never tells.
    virtual Actions disconnected(std::size_t /*port*/, Address /*peer*/, Time /*now*/) { return {}; }
    /// The rate, bit/s, that a driver has set on its end of a serial line. A device that follows it
    /// (automatic baud) is as slow as that from now on.
    virtual void line_rate(std::size_t /*port*/, double /*rate*/) {}
    virtual DeviceCounters counters() const = 0;
};

}  // namespace echoloop
