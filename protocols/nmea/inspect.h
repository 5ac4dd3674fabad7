// NMEA 0183's row in the table of families. Never used by devices.
#pragma once

#include "protocols/inspect.h"

namespace echoloop::nmea {

/// Sentences of any talker, with noise between them. One whose checksum or fields are wrong says so.
std::vector<inspect::Message> decode(wire::ByteView bytes);
/// A sentence with a checksum that fits.
bool recognise(wire::ByteView bytes);
std::vector<wire::Table> tables();
wire::Bytes rewritten(wire::ByteView bytes);
std::vector<ChecksumPlace> checksums(wire::ByteView bytes);

}  // namespace echoloop::nmea
