// What a file of captured traffic holds, one event after the other, without holding the file in memory. Knows
// no protocol family.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "tools/capture/input.h"
#include "tools/capture/packet.h"

namespace echoloop::capture {

struct CaptureCounts {
    std::uint64_t packets = 0;
    std::uint64_t skipped = 0;        ///< no UDP or TCP over IPv4, no serial line, or broken
    std::size_t incomplete = 0;       ///< datagrams of which fragments are missing
    std::string fault;                ///< why reading ended before the end of the file; empty: it did not
    std::uint64_t damaged_bytes = 0;  ///< passed over, up to the next good record
    std::uint64_t first_damage = 0;   ///< B, where in the file
    std::uint64_t steps_back = 0;     ///< times that the clock of the file was set back
    double first_step = 0;            ///< s
    std::string step_place{};         ///< "packet 11"
};

/// Bytes that come next on a serial line or in one direction of a TCP connection.
struct StreamPiece {
    std::string line;   ///< name of a serial line's interface; "" for TCP
    bool sent = false;  ///< serial: by the capturing side
    Address from, to;   ///< TCP
    Bytes bytes;
    bool gap = false;  ///< the capture lacks bytes before these
};

struct CaptureEvent {
    double time = 0;             ///< s since 1970, or by the clock of the file
    std::string interface {};    ///< of the capture; "" where it has none
    std::optional<bool> sent{};  ///< by the capturing side; empty: the capture does not say
    std::variant<Datagram, StreamPiece> content{};
    std::uint64_t packet = 0;  ///< number of the packet that it came with, from 1
    std::string comment{};     ///< of that packet
    std::string clock{};       ///< what the time is counted for, where times of several sorts are in one file
};

class CaptureReader {
  public:
    CaptureReader() = default;
    virtual ~CaptureReader() = default;
    CaptureReader(const CaptureReader&) = delete;
    CaptureReader& operator=(const CaptureReader&) = delete;

    /// In the order of the file; empty at its end or after a fault.
    virtual std::optional<CaptureEvent> next() = 0;
    virtual CaptureCounts counts() const = 0;
    /// True if echoloop wrote the capture: then an interface is a port of a device, and it says who speaks.
    virtual bool of_ports() const { return false; }
};

/// A pcap or pcapng file. `input` outlives it. Throws StartError (data) if it is none that can be read.
std::unique_ptr<CaptureReader> open_packets(Input& input);

}  // namespace echoloop::capture
