// KMALL's row in the table of families. Never used by devices.
#pragma once

#include "protocols/inspect.h"
#include "protocols/kmall/codec.h"

namespace echoloop::kmall {

/// One datagram, or several back to back as in a .kmall file. The last part of a divided one is told as the
/// whole.
std::vector<inspect::Message> decode(wire::ByteView bytes);
std::vector<wire::Table> tables();
wire::Bytes rewritten(wire::ByteView bytes);

}  // namespace echoloop::kmall
