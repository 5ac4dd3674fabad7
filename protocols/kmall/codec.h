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

/// A datagram of more than `most` bytes in parts, each with header and partition of its own. The bytes behind
/// the partition are cut at an even place; where is our own choice.
std::vector<wire::Bytes> divided(wire::Bytes datagram, std::size_t most = largest_datagram);

/// Adds a part of a divided datagram to those before it in `held`, which holds none at first. True if it was
/// the last: then `held` is the whole datagram, as it stands in a file. A first part begins anew; one that
/// does not follow on the one before is lost with those. What is no part leaves `held` as it is.
bool join(wire::Bytes& held, wire::ByteView part);

/// "MRZ", "MWC part", "IIP", "KSSIS", "S01"; lives as long as the datagram.
std::string_view name_of(const Datagram& datagram);

}  // namespace echoloop::kmall
