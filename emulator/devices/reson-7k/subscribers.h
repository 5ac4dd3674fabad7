// Who is told which records of a 7k sonar: hosts on TCP, and hosts by UDP. Knows no records' content and
// no time.
#pragma once

#include <set>
#include <span>
#include <vector>

#include "emulator/contract/device.h"

namespace echoloop::reson7k_device {

enum PortIndex : std::size_t { stream_port, datagram_port };

/// One end of a connection.
struct Peer {
    std::size_t port = stream_port;
    Address address;
    friend bool operator==(const Peer&, const Peer&) = default;
};

/// Records that the sonar sends with every ping, in the order in which they go out.
std::span<const std::uint32_t> ping_records();

class Subscribers {
  public:
    struct Entry {
        Peer peer;
        std::set<std::uint32_t> types;
    };

    /// False if there are too many peers already.
    bool add(const Peer& peer, const std::set<std::uint32_t>& types);
    /// Takes types from a peer's subscription; it ends with the last one.
    void remove(const Peer& peer, const std::set<std::uint32_t>& types);
    /// False if the peer had no subscription.
    bool end(const Peer& peer);
    bool wanted(std::uint32_t type) const;
    bool wanted(std::span<const std::uint32_t> types) const;  ///< one of them
    const std::vector<Entry>& entries() const { return entries_; }

  private:
    std::vector<Entry> entries_;
};

}  // namespace echoloop::reson7k_device
