// The row of edgetech in the table of families. Never used by devices.
#pragma once

#include "protocols/inspect.h"

namespace echoloop::edgetech {

/// Messages, with noise between them.
std::vector<inspect::Message> decode(wire::ByteView bytes);
bool recognise(wire::ByteView bytes);
std::vector<wire::Table> tables();
wire::Bytes rewritten(wire::ByteView bytes);

}  // namespace echoloop::edgetech
