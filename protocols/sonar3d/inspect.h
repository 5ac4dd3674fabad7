// The Sonar 3D-15's row in the table of families. Never used by devices.
#pragma once

#include "protocols/inspect.h"

namespace echoloop::sonar3d {

/// Packets one behind the other, as in a .sonar file, with noise between them.
std::vector<inspect::Message> decode(wire::ByteView bytes);
/// A packet whose checksum is right.
bool recognise(wire::ByteView bytes);
std::vector<wire::Table> tables();
wire::Bytes rewritten(wire::ByteView bytes);
std::vector<ChecksumPlace> checksums(wire::ByteView bytes);

}  // namespace echoloop::sonar3d
