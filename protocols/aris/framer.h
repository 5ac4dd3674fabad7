// Cuts the TCP stream of a controller into commands, and skips and counts everything else.
#pragma once

#include "protocols/aris/codec.h"
#include "protocols/wire/framer.h"

namespace echoloop::aris {

/// A command begins where a length stands that a command can have, and what follows is one. Where another one
/// stands whole within a command that is not, or not yet, there, bytes of the first were lost: it is skipped.
struct CommandFinder {
    wire::Found<Command> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {.before = length_bytes + longest_command}; }
};

using Framer = wire::Framer<Command, CommandFinder>;

}  // namespace echoloop::aris
