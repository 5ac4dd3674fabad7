// The lines of a Tritech altimeter as text and as values, and their framer.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocols/wire/framer.h"

namespace echoloop::altimeter {

enum class Format {
    three_decimals,  ///< "xxx.xxxm" CR LF
    two_decimals,    ///< "xxx.xxm" CR LF
    millimetres,     ///< "dmm" LF
};

struct Reading {
    Format format = Format::three_decimals;
    double metres = 0;  ///< 0 to 999.99
};

/// With its line end; metres beyond what the format has room for are cut.
std::string write_line(const Reading& reading);
/// A whole line with its end and nothing before it; nothing if it is none.
std::optional<Reading> read_line(std::string_view line);

/// What stands before the first line end of pending bytes is a line as far as it reads as one; everything
/// before it is skipped.
struct LineFinder {
    wire::Found<Reading> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {}; }
};

using Framer = wire::Framer<Reading, LineFinder>;

}  // namespace echoloop::altimeter
