// Ranges of overlapping beams, made to agree. Pure functions; knows no message.
#pragma once

#include <span>
#include <vector>

namespace echoloop::delta_t {

/// Each range, m, becomes that of the straight bottom through those within `reach` rad on either side; at the
/// edges of the fan through those within 4 `reach` on one, beside a step or a bend through those on its own
/// side of it, where there are enough within 3.2 `reach`. What does not lie on one with its neighbours stays
/// as it is, and so does 0, which is none. `angles`: rad, ascending.
std::vector<double> smoothed(std::span<const double> ranges, std::span<const double> angles, double reach);

}  // namespace echoloop::delta_t
