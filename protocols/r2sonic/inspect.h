// R2Sonic's row in the table of families. Never used by devices.
#pragma once

#include "protocols/inspect.h"
#include "protocols/r2sonic/codec.h"

namespace echoloop::r2sonic {

/// One datagram.
std::vector<inspect::Message> decode(wire::ByteView bytes);
std::vector<wire::Table> tables();
wire::Bytes rewritten(wire::ByteView bytes);

}  // namespace echoloop::r2sonic
