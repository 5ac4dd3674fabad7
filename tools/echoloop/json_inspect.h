// The --json lines of `echoloop inspect`, one a message. Text only; it writes nothing.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulator/contract/device.h"
#include "protocols/inspect.h"

namespace echoloop::cli {

/// Where a message of `echoloop inspect` comes from; addresses and time (s since the first datagram) only for
/// captures.
struct InspectOrigin {
    std::string family{};
    double time = 0;
    std::optional<Address> from{}, to{};
    std::string line{};        ///< serial: which, and who speaks
    std::uint64_t packet = 0;  ///< number of the packet that completed it, from 1; 0: there are none
};
/// What a capture says beside the bytes, e.g. which fault the packet has suffered.
struct PacketComment {
    std::uint64_t packet = 0;  ///< from 1
    double time = 0;           ///< s since the first packet
    std::string text{};
};
struct InspectSummary {
    std::map<std::string, std::size_t> messages;  ///< decoded ones by name
    std::size_t broken = 0;                       ///< messages that could be named but not decoded
    std::size_t undecoded_bytes = 0;
    std::optional<std::uint64_t> packets;  ///< captures only
    std::uint64_t skipped_packets = 0;
    std::size_t incomplete = 0;
    std::size_t comments = 0;
};
std::string comments_json(const std::vector<PacketComment>& comments);
std::string message_json(const InspectOrigin& origin, const inspect::Message& message);
std::string summary_json(const InspectSummary& summary);

}  // namespace echoloop::cli
