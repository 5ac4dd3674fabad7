// The acoustic chain over a ping's beams, row by row where it has rows. Knows no pixels.
#pragma once

#include "render/acoustics/chain.h"

namespace echoloop {

/// As AcousticChain::apply() with the values of a ping; fills in the noise power too. Rows that share staves
/// share random numbers, as beams of a row do. `points`: by number of beam within the ping, in any order.
void apply_to_rows(AcousticChain& chain, std::vector<PointEcho> points, Echogram& echogram,
                   FreshPower fresh = {});

}  // namespace echoloop
