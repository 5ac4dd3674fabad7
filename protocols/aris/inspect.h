// ARIS messages for `echoloop inspect`: the row in the table of families. Never used by devices.
#pragma once

#include "protocols/inspect.h"

namespace echoloop::aris {

/// A beacon, a part of a frame, or the commands of a stream with noise between them.
std::vector<inspect::Message> decode(wire::ByteView bytes);
bool recognise(wire::ByteView bytes);
std::vector<wire::Table> tables();
wire::Bytes rewritten(wire::ByteView bytes);

}  // namespace echoloop::aris
