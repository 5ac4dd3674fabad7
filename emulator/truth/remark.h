// What a recording says in a comment about a ping, and how that is read back.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "emulator/contract/transmission.h"
#include "render/geographic.h"

namespace echoloop {

/// What a sonar's place means in its world.
struct Surroundings {
    std::optional<GeoPlace> place{};   ///< on the Earth, if that is known
    std::optional<double> altitude{};  ///< m above what lies below it
};

/// "ping 12: t 1.234000 s, sonar at 1.000 2.000 -3.000 m, orientation w 1.00000 x 0.00000 y 0.00000 z
/// 0.00000", then ", latitude 59.400000000 longitude 10.500000000" and ", 4.020 m above the bottom" where
/// these are known.
std::string remark_of(const Transmission& transmission, std::uint64_t number,
                      const Surroundings& around = {});

struct Remark {
    double time = 0;  ///< s, of the run
    Pose world_from_sonar;
    Surroundings around;  ///< without a height
};
/// The first such comment among the lines of a packet's.
std::optional<Remark> read_remark(const std::string& comment);

}  // namespace echoloop
