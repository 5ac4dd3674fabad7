// What altimeters say, as bytes and as values, and their framer: lines of Tritech, Benthos and Echologger,
// four bytes of an Imagenex 863.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocols/wire/framer.h"

namespace echoloop::altimeter {

enum class Format {
    three_decimals,  ///< "xxx.xxxm" CR LF
    two_decimals,    ///< "xxx.xxm" CR LF
    millimetres,     ///< "dmm" LF
    two_digits,      ///< "xx.xxxm" CR LF
    benthos,         ///< "Rxx.xx" CR LF, a mark before the end
    metres,          ///< "x.xxx" CR LF, of an Echologger; three digits before the point at most
    centimetres,     ///< "xxxxx" CR LF
    time,            ///< FF, time of flight in us high and low, level
};

struct Reading {
    Format format = Format::three_decimals;
    double metres = 0;               ///< 0 to 999.99
    char letter = 0;                 ///< three_decimals: address A to H before the number; 0: none
    char mark = 0;                   ///< benthos: E without an echo, < below the range; 0: none
    std::uint16_t microseconds = 0;  ///< time: there and back, 0 without an echo; in place of metres
    std::uint8_t level = 0;          ///< time: of the echo
};

/// With its line end; metres beyond what the format has room for are cut.
std::string write_line(const Reading& reading);
/// A whole line with its end and nothing before it; nothing if it is none.
std::optional<Reading> read_line(std::string_view line);
/// Whether the format is no other device's either: numbers alone and four bytes may be anybody's.
bool is_sure(Format format);

/// What stands before the first line end of pending bytes is a line as far as it reads as one; everything
/// before it is skipped. Numbers alone must begin their line. Times are not marked: FF begins one where
/// another message ends, if FF begins the next one, too, or nothing follows.
struct LineFinder {
    wire::Found<Reading> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {}; }
};

using Framer = wire::Framer<Reading, LineFinder>;

}  // namespace echoloop::altimeter
