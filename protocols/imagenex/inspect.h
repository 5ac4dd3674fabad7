// The Imagenex row in the table of families. Never used by devices.
#pragma once

#include "protocols/inspect.h"

namespace echoloop::imagenex {

/// Commands and replies of a line, and the shots of .81A, .852 and .31L files with the replies in them.
std::vector<inspect::Message> decode(wire::ByteView bytes);
bool recognise(wire::ByteView bytes);
std::vector<wire::Table> tables();
wire::Bytes rewritten(wire::ByteView bytes);

}  // namespace echoloop::imagenex
