// Round figures for axes and rings.
#pragma once

#include <string>
#include <vector>

namespace echoloop::draw {

/// Step of 1, 2 or 5 times a power of ten that cuts `length` into about `parts`.
double round_step(double length, double parts);

/// The multiples of `step` from `begin` to `end`, both included.
std::vector<double> ticks(double begin, double end, double step);

/// A figure as it stands beside an axis, without the last bits of a sum.
std::string tick_label(double value);

}  // namespace echoloop::draw
