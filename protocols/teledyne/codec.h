// PD0 ensembles and PD5 blocks to bytes and back, and what a Teledyne log says, found in a stream. Knows no
// state, time or device.
#pragma once

#include <optional>

#include "protocols/teledyne/messages.h"
#include "protocols/wire/framer.h"
#include "protocols/wire/result.h"

namespace echoloop::teledyne {

inline constexpr std::size_t pd5_size = 88;            ///< bytes
inline constexpr std::size_t longest_ensemble = 8192;  ///< bytes; 255 cells make 5.4 kB
inline constexpr std::size_t longest_line = 200;       ///< characters of the console

/// Where the sections of an ensemble lie, from its first byte; nothing: the bytes are no beginning of one, or
/// too few.
struct Contents {
    std::size_t size = 0;  ///< bytes before the checksum
    std::vector<std::size_t> offsets;
};
std::optional<Contents> read_contents(wire::ByteView bytes);

/// With the checksum behind it. It has less than 65536 bytes and 256 sections.
wire::Bytes encode(const Ensemble& ensemble);
/// With a checksum that fits, whatever the member says.
wire::Bytes encode(Pd5 block);
/// What these bytes are, all of them; the checksum fits.
wire::Result<Ensemble> parse_ensemble(wire::ByteView bytes);
wire::Result<Pd5> parse_pd5(wire::ByteView bytes);
/// 16 bits.
std::uint16_t sum(wire::ByteView bytes);

struct Piece {
    enum class Kind { ensemble, pd4, pd5, line };
    Kind kind = Kind::ensemble;
    wire::Bytes bytes;  ///< a line of the console without its end
    std::string line_end;

    std::size_t size() const { return bytes.size() + line_end.size(); }
};

/// Ensembles and blocks whose checksums fit, lines of the console. Line ends alone are no noise.
struct PieceFinder {
    wire::Found<Piece> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {}; }
};

using Framer = wire::Framer<Piece, PieceFinder>;

}  // namespace echoloop::teledyne
