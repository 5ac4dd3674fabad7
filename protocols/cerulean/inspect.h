// The row of Cerulean sonars in the table of families. Never used by devices.
#pragma once

#include "protocols/inspect.h"

namespace echoloop::cerulean {

/// Frames of both directions, with noise between them.
std::vector<inspect::Message> decode(wire::ByteView bytes);
/// True if there is a message that only a Cerulean sonar or its host sends, whole in the form of its table.
/// Ids that a Blue Robotics Ping1D has too prove nothing.
bool recognise(wire::ByteView bytes);
std::vector<wire::Table> tables();
wire::Bytes rewritten(wire::ByteView bytes);

}  // namespace echoloop::cerulean
