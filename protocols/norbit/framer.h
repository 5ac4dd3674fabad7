// Cuts a TCP stream into packets of a Norbit WBMS, and skips and counts everything else.
#pragma once

#include "protocols/norbit/codec.h"
#include "protocols/wire/framer.h"

namespace echoloop::norbit {

/// A packet begins where a plausible header stands and ends with its size; types 1 and 2 need their checksum.
struct PacketFinder {
    wire::Found<Frame> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {.before = max_packet}; }
};

using Framer = wire::Framer<Frame, PacketFinder>;

}  // namespace echoloop::norbit
