// What motion sensors say to survey sonars, as bytes and as values, and their framer: TSS1 lines and the ten
// bytes of Kongsberg's EM Attitude 3000. As Simrad's EK80 Reference manual ("Datagram formats") and NovaTel's
// manual of TSS1 describe them.
#pragma once

#include <cstdint>
#include <optional>

#include "protocols/wire/framer.h"

namespace echoloop::motion {

enum class Format {
    tss1,    ///< ":XXAAAA MHHHHQMRRRR MPPPP" CR LF
    em3000,  ///< status, 90, then roll, pitch, heave, heading, two bytes each, low byte first
};

/// Roll with port up, pitch with the bow up. A zero with a sign keeps it, since TSS1 writes signs apart.
struct Reading {
    Format format = Format::tss1;
    double roll = 0, pitch = 0;  ///< deg, to 99.99 (TSS1) and 179.99
    double heave = 0;            ///< m, up, to 99.99 (TSS1) and 9.99
    double heading = 0;          ///< deg, 0 to 359.99; EM Attitude 3000
    double horizontal = 0;       ///< m/s^2, 0 to 9.77; TSS1
    double vertical = 0;         ///< m/s^2, up, to 20.48; TSS1
    /// TSS1: how it is aided, u g h f, in capitals once it has settled. EM Attitude 3000: 90 valid, to 99
    /// less accurate, to 9F not valid, to AF at fault.
    std::uint8_t status = 'F';
};

inline constexpr double horizontal_step = 0.0383, vertical_step = 0.000625;  // m/s^2, of TSS1

/// Values beyond what the format has room for are cut.
wire::Bytes write(const Reading& reading);
/// A whole message and nothing else; nothing if it is none. Of EM Attitude 3000 only those with a status,
/// not an EM1000's with 00 in its place, and only values in their valid ranges.
std::optional<Reading> read(wire::ByteView bytes);

/// An EM Attitude 3000 has no end and no checksum: it counts if another message or nothing follows it.
struct Finder {
    wire::Found<Reading> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {}; }
};

using Framer = wire::Framer<Reading, Finder>;

}  // namespace echoloop::motion
