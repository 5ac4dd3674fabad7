// The NMEA 0183 sentences of an echosounder as text: checksum, depth, temperature. Writes only; reads
// nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace echoloop::nmea {

/// Exclusive or of all characters between '$' and '*'.
std::uint8_t checksum(std::string_view body);

/// "$" body "*hh" CR LF. `body` is talker, formatter and fields, e.g. "SDMTW,10.0,C".
std::string sentence(std::string_view body);

/// How a talker writes its sentences.
struct Style {
    std::string talker = "SD";  ///< two characters; SD: depth sounder
    int decimals = 2;           ///< of depths, in any unit
};

/// Depth of the bottom in m; empty where it was not found: null fields, as the standard has them.
using Depth = std::optional<double>;

/// DBT, below the transducer, DBS, below the surface, or DBK, below the keel: feet, metres and fathoms.
std::string depth_below(std::string_view formatter, Depth metres, const Style& style);

/// DPT: depth below the transducer, its offset in m (positive: up to the water line, negative: down to the
/// keel) and, from NMEA 0183 version 3.0 on, the greatest depth of the range in use in m.
std::string dpt(Depth metres, double offset, std::optional<double> range, const Style& style);

/// MTW: temperature of the water in degrees Celsius.
std::string mtw(double celsius, const Style& style);

}  // namespace echoloop::nmea
