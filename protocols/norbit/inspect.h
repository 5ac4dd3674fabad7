// Packets of a Norbit WBMS for `echoloop inspect`: the row in the table of families. Never used by devices.
#pragma once

#include "protocols/inspect.h"

namespace echoloop::norbit {

/// Packets of a TCP stream, with noise between them.
std::vector<inspect::Message> decode(wire::ByteView bytes);
bool recognise(wire::ByteView bytes);
std::vector<wire::Table> tables();
wire::Bytes rewritten(wire::ByteView bytes);
std::vector<ChecksumPlace> checksums(wire::ByteView bytes);

}  // namespace echoloop::norbit
