// Cuts a byte stream into NMEA 0183 sentences, and skips and counts everything else.
#pragma once

#include <string>

#include "protocols/wire/framer.h"

namespace echoloop::nmea {

/// The standard ends at 82 characters; makers' own sentences do not keep to it.
inline constexpr std::size_t longest_line = 512;

/// A line that looks like a sentence: '$' or '!', an address of capital letters and digits, printable
/// characters, CR LF or LF. Its checksum has not been looked at.
struct Line {
    std::string text;  ///< from '$' to the character before the line's end
};

/// At the end of a stream a line may end behind its checksum.
struct LineFinder {
    wire::Found<Line> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {}; }
};

using Framer = wire::Framer<Line, LineFinder>;

}  // namespace echoloop::nmea
