// Cuts a byte stream into NMEA 0183 sentences, and skips and counts everything else. Never opens or waits for
// anything.
#pragma once

#include "protocols/text_framer.h"

namespace echoloop::nmea {

/// The standard ends at 82 characters; makers' own sentences do not keep to it.
inline constexpr std::size_t longest_line = 512;

/// A line that looks like a sentence: '$' or '!', an address of capital letters and digits, printable
/// characters, CR LF or LF. Its checksum has not been looked at.
struct Line {
    std::string text;      ///< from '$' to the character before the line's end
    std::size_t size = 0;  ///< bytes, with the line's end
};

/// The sentence that pending bytes begin with, or the bytes before the next place where one may begin. At the
/// end of a stream a line may end behind its checksum.
TextFound<Line> look(std::string_view pending, bool finished);

using Framer = TextFramer<Line, look>;

}  // namespace echoloop::nmea
