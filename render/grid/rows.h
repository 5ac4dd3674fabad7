// The acoustic chain over a grid's beams, row by row. Knows no pixels.
#pragma once

#include "render/acoustics/chain.h"

namespace echoloop {

/// As AcousticChain::apply() with the values of a grid's ping; fills in the noise power too. Each row has
/// random numbers of its own. `points`: by number of beam within the grid, in any order.
void apply_to_rows(AcousticChain& chain, std::vector<PointEcho> points, Echogram& echogram);

}  // namespace echoloop
