// UDP datagrams, TCP segments and bytes of serial lines out of captured packets: link, IPv4, UDP and TCP
// headers, fragments put together. Takes any bytes: what is none of these, or is broken, is counted and
// skipped. Opens nothing.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <variant>
#include <vector>

#include "emulator/contract/device.h"

namespace echoloop::capture {

struct Datagram {
    Address from, to;
    Bytes payload;
    bool cut = false;  ///< the capture holds fewer bytes than were sent
};

struct TcpSegment {
    Address from, to;
    std::uint32_t sequence = 0;  ///< of the first byte
    bool begins = false;         ///< SYN: a new connection
    Bytes payload;
};

/// What a driver or a device put on a serial line.
struct SerialBytes {
    bool sent = false;  ///< by the capturing side
    Bytes payload;
};

using Packet = std::variant<std::monostate, Datagram, TcpSegment, SerialBytes>;

class PacketReader {
  public:
    /// `link_type`: DLT_* of libpcap. False if packets of that link cannot be read.
    static bool reads(int link_type);

    /// What the packet holds or completes; nothing if it is skipped or waits for more fragments.
    Packet read(int link_type, ByteView packet);

    std::uint64_t skipped() const { return skipped_; }  ///< other protocols and broken packets
    /// Datagrams of which fragments are missing so far.
    std::size_t incomplete() const { return partials_.size(); }

  private:
    using Key =
        std::tuple<std::uint32_t, std::uint32_t, std::uint16_t>;  ///< source, destination, identification
    struct Partial {
        Bytes bytes;
        std::map<std::size_t, std::size_t> pieces;  ///< first byte -> one behind the last
        std::optional<std::size_t> total;
        std::uint64_t age = 0;
    };

    Packet read_ipv4(ByteView packet);
    Packet skip();
    std::optional<Bytes> assemble(const Key& key, ByteView piece, std::size_t at, bool more);
    void forget_oldest();

    std::uint64_t skipped_ = 0;
    std::uint64_t clock_ = 0;
    std::map<Key, Partial> partials_;
};

}  // namespace echoloop::capture
