// Packets of a Wayfinder to bytes and back, and found in a stream. Knows no state, time or device.
#pragma once

#include "protocols/wayfinder/messages.h"
#include "protocols/wire/framer.h"
#include "protocols/wire/result.h"

namespace echoloop::wayfinder {

inline constexpr std::size_t longest_packet = 33000;  ///< bytes, of the maker's driver

/// With header and sums that fit, those of data whatever the member says.
wire::Bytes encode(const Packet& packet);
/// The packet that these bytes are, all of them; its sum fits, and of data the inner one too. Parameters and
/// structures that do not fit their command are kept as bytes.
wire::Result<Packet> parse(wire::ByteView bytes);
/// 16 bits.
std::uint16_t sum(wire::ByteView bytes);

/// The bytes of a packet whose sizes agree and whose sum fits. One of wrong sizes is told by its first nine
/// bytes, so that it holds up nothing behind it.
struct PacketFinder {
    wire::Found<wire::Bytes> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {}; }
};

using Framer = wire::Framer<wire::Bytes, PacketFinder>;

}  // namespace echoloop::wayfinder
