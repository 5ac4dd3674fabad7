// UDP datagrams out of captured packets: link, IPv4 and UDP headers, fragments put together. Takes any bytes:
// what is no UDP over IPv4, or is broken, is counted and skipped. Opens nothing.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "emulator/device.h"

namespace echoloop::cli {

struct Datagram {
    Address from, to;
    Bytes payload;
    bool cut = false;  ///< the capture holds fewer bytes than were sent
};

class PacketReader {
  public:
    /// `link_type`: DLT_* of libpcap. False if packets of that link cannot be read.
    static bool reads(int link_type);
    explicit PacketReader(int link_type) : link_type_(link_type) {}

    /// The datagram that the packet holds or completes.
    std::optional<Datagram> read(ByteView packet);

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

    std::optional<Datagram> read_ipv4(ByteView packet);
    std::optional<Bytes> assemble(const Key& key, ByteView piece, std::size_t at, bool more);
    void forget_oldest();

    int link_type_;
    std::uint64_t skipped_ = 0;
    std::uint64_t clock_ = 0;
    std::map<Key, Partial> partials_;
};

}  // namespace echoloop::cli
