// KMALL datagrams to bytes and back. Knows no state, time or device.
#pragma once

#include "protocols/kmall/messages.h"
#include "protocols/wire/result.h"

namespace echoloop::kmall {

/// True if the bytes begin as a KMALL datagram or a controller's text does.
bool recognise(wire::ByteView bytes);

/// Bytes of the first datagram in a file: its size field; all of a text or of what is no datagram.
std::size_t datagram_size(wire::ByteView bytes);

/// One datagram, all of it. Structs may be longer than known, as their size fields say; the rest is skipped.
wire::Result<Datagram> parse(wire::ByteView datagram);

/// Sizes and counts follow from the vectors; the sizes of structs are those that they hold, or the known ones
/// where they hold 0.
wire::Bytes serialise(const Datagram& datagram);

/// A datagram of more than `largest_datagram` bytes in parts, each with header and partition of its own.
/// Where the bytes behind the partition are cut is our own choice.
std::vector<wire::Bytes> divided(wire::Bytes datagram);

/// "MRZ", "MWC part", "IIP", "KSSIS".
std::string_view name_of(const Datagram& datagram);

}  // namespace echoloop::kmall
