// Cuts a byte stream into packets of a Sonar 3D-15, and skips and counts everything else.
#pragma once

#include "protocols/wire/framer.h"

namespace echoloop::sonar3d {

/// A packet is bytes whose id, length and checksum are right.
struct PacketFinder {
    wire::Found<wire::Bytes> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {}; }
};

using Framer = wire::Framer<wire::Bytes, PacketFinder>;

}  // namespace echoloop::sonar3d
