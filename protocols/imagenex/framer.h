// Cuts a byte stream into Imagenex commands, replies and shots of files, and skips and counts everything
// else.
#pragma once

#include "protocols/wire/framer.h"

namespace echoloop::imagenex {

/// There is no checksum: a command is 27 bytes from FE 44 to the first FD; a reply is told by its name, a
/// legal count and FC at its end. The search goes on at the byte behind the start of what was none.
class FrameFinder {
  public:
    enum class Takes {
        everything,  ///< both directions of a line, and the shots of .81A, .852 and .31L files
        commands     ///< what a head listens for; nothing else on the line can hold it up
    };
    explicit FrameFinder(Takes takes = Takes::everything) : takes_(takes) {}

    wire::Found<wire::Bytes> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {.with = std::size_t{128} << 10}; }

  private:
    Takes takes_;
};

using Framer = wire::Framer<wire::Bytes, FrameFinder>;

}  // namespace echoloop::imagenex
