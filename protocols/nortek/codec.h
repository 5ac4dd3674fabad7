// Nortek's frames to bytes and back, and what a Nucleus or a DVL and its host say, found in a stream. Knows
// no state, time or device.
#pragma once

#include "protocols/nortek/messages.h"
#include "protocols/wire/framer.h"
#include "protocols/wire/result.h"

namespace echoloop::nortek {

inline constexpr std::size_t header_size = 10;    ///< bytes
inline constexpr std::size_t longest_line = 512;  ///< characters

/// 16-bit words summed up from 0xB58C on, the last odd byte being the high one.
std::uint16_t checksum(wire::ByteView bytes);
/// With its header, whose sums fit. Data have less than 65536 bytes.
wire::Bytes encode(const Frame& frame);
/// The frame that these bytes are, all of them; both sums fit.
wire::Result<Frame> parse(wire::ByteView bytes);

struct Piece {
    enum class Kind { frame, line };
    Kind kind = Kind::frame;
    wire::Bytes bytes;  ///< a line without its end
    std::string line_end;

    std::size_t size() const { return bytes.size() + line_end.size(); }
};

/// Frames whose sums fit, and lines. Line ends alone are no noise.
struct PieceFinder {
    wire::Found<Piece> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {}; }
};

using Framer = wire::Framer<Piece, PieceFinder>;

}  // namespace echoloop::nortek
