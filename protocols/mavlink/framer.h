// Cuts a byte stream into MAVLink frames of versions 1 and 2, and skips and counts everything else.
#pragma once

#include "protocols/mavlink/messages.h"
#include "protocols/wire/framer.h"

namespace echoloop::mavlink {

/// Messages that this folder knows are taken if their checksum is right, also from behind what looks like the
/// beginning of another one. Of others the seed of the checksum is not known: they are passed over by their
/// length, and are no noise.
struct FrameFinder {
    wire::Found<Frame> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {.with = 65536}; }
};

using Framer = wire::Framer<Frame, FrameFinder>;

}  // namespace echoloop::mavlink
