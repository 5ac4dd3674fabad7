// What one beam hears of rough mirrors one after the other, through its own pattern with side lobes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/paths/chains.h"
#include "render/paths/path_ping.h"
#include "render/paths/paths.h"

namespace echoloop {

/// The incoherent part of a path by several mirrors.
struct RoughChain {
    std::span<const ChainMirror> mirrors;  ///< two or more, in the order in which sound meets them
    double range = 0;                      ///< m, half the length of the path if all were smooth
    FanDirection leaves, arrives;          ///< of that path
    double power = 0;                      ///< uPa^2, as if the pattern were 1 everywhere
};

/// Adds 64 echoes of directions in which sound leaves and arrives. The pair of both deviates from the smooth
/// path normally, as the facets' slopes and chain_share()'s a and b say, and each is weighed by the beam's
/// pattern, so that the mean over pings is the integral. Each echo is late by what its legs are longer, in
/// the approximation of small angles; between the first and the last mirror the way is straight, but for what
/// those in between turn it. So a second bottom fades through the side lobes, over a metre and a half before
/// an Imagenex 852 as in its recording, where a Gaussian beam ends it after four samples.
///
/// Directions are drawn about the beam's axis with the density 1 / (pi (1 + r^2)^2), r in half widths, by
/// Roberts' sequence R5, which goes on from ping to ping; `number` tells the chains of a ping apart. Returns
/// false, and adds nothing, where the pattern is a box, where the smooth path lies 20 dB below the axis or
/// fainter, or where one rough mirror alone turns it, so that both directions are the same.
bool add_through_pattern(const PathPing& ping, const RoughChain& chain, std::uint64_t number,
                         std::vector<PathEcho>& out);

}  // namespace echoloop
