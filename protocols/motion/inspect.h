// The row of motion sensors in the table of families. Never used by devices.
#pragma once

#include "protocols/inspect.h"

namespace echoloop::motion {

std::vector<inspect::Message> decode(wire::ByteView bytes);
/// A TSS1 line, or EM Attitude 3000 messages and little else.
bool recognise(wire::ByteView bytes);
std::vector<wire::Table> tables();
wire::Bytes rewritten(wire::ByteView bytes);

}  // namespace echoloop::motion
