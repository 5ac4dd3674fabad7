// The row of Teledyne's Wayfinder in the table of families. Never used by devices.
#pragma once

#include "protocols/checksums.h"
#include "protocols/inspect.h"

namespace echoloop::wayfinder {

/// Messages, with noise between them.
std::vector<inspect::Message> decode(wire::ByteView bytes);
bool recognise(wire::ByteView bytes);
std::vector<wire::Table> tables();
wire::Bytes rewritten(wire::ByteView bytes);
std::vector<ChecksumPlace> checksums(wire::ByteView bytes);

}  // namespace echoloop::wayfinder
