// Oculus messages for `echoloop inspect`: the row in the table of families. Never used by devices.
#pragma once

#include "protocols/inspect.h"

namespace echoloop::oculus {

/// Messages of the TCP stream, either way, with noise between them; or the status datagram.
std::vector<inspect::Message> decode(wire::ByteView bytes);
bool recognise(wire::ByteView bytes);
std::vector<wire::Table> tables();
wire::Bytes rewritten(wire::ByteView bytes);

}  // namespace echoloop::oculus
