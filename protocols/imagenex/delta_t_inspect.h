// The Delta T's row in the table of families. Never used by devices.
#pragma once

#include "protocols/inspect.h"

namespace echoloop::imagenex {

/// 83P and EC, as a datagram each or one after the other as in a .83P file.
std::vector<inspect::Message> decode_delta_t(wire::ByteView bytes);
bool recognise_delta_t(wire::ByteView bytes);
std::vector<wire::Table> delta_t_tables();
wire::Bytes rewritten_delta_t(wire::ByteView bytes);

}  // namespace echoloop::imagenex
