// Cuts what a Water Linked DVL or its host says into pieces, whichever of its four protocols it is, and skips
// and counts everything else.
#pragma once

#include <string>

#include "protocols/wire/framer.h"

namespace echoloop::waterlinked {

inline constexpr std::size_t longest_line = 512;    ///< B, of the serial protocol and of PD6
inline constexpr std::size_t longest_json = 65536;  ///< B, of an object

/// Not looked at closely yet.
struct Piece {
    enum class Kind {
        json,      ///< an object or an array, with or without a line end
        sentence,  ///< 'w', 'c' or 'r', and so on, to the line's end
        pd6,       ///< ':' and two capitals, to the line's end
        pd4,       ///< 47 bytes that begin as a PD4 block does
    };
    Kind kind = Kind::json;
    std::string text;      ///< without the line's end
    std::string line_end;  ///< CR LF, LF, CR or none

    std::size_t size() const { return text.size() + line_end.size(); }
    friend bool operator==(const Piece&, const Piece&) = default;
};

/// Blank characters between pieces are no noise. At the end of a stream a sentence may end behind its
/// checksum.
struct PieceFinder {
    wire::Found<Piece> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {}; }
};

using Framer = wire::Framer<Piece, PieceFinder>;

}  // namespace echoloop::waterlinked
