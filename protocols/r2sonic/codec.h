// R2Sonic datagrams to structs and back, by the tables of layouts.h. Knows no state, time or device.
#pragma once

#include <string>
#include <string_view>

#include "protocols/r2sonic/messages.h"
#include "protocols/wire/bytes.h"
#include "protocols/wire/result.h"

namespace echoloop::r2sonic {

/// The packet in a datagram, told by its first characters. Sections stand in the order that readers walk;
/// their sizes, their padding and the PacketSize must be right. Unknown sections are skipped and another
/// order of the known ones is accepted, as the maker lets parsers do.
wire::Result<Packet> parse(wire::ByteView datagram);

/// True if the datagram starts with the name of a packet that has a layout.
bool recognise(wire::ByteView bytes);

/// The whole datagram. H0.points, PacketSize and all section sizes are written from the arrays' sizes. An
/// array whose size does not fit the others (say I1 shorter than R0) is cut or filled with zeros.
wire::Bytes serialise(const Packet& packet);

/// Where the data of M0, M1 and M2 begins in a datagram that holds nothing else: behind 12 bytes of packet
/// header and 36 of the section. Big images are written there straight away.
inline constexpr std::size_t part_data_offset = 48;

/// "BTH0", "AID0", ...
std::string_view name_of(const Packet& packet);

}  // namespace echoloop::r2sonic
