// A flat outline that is drawn up into a body, as SDF's polyline.
#pragma once

#include <array>
#include <vector>

#include "tools/import/shape.h"

namespace echoloop::worlds {

/// Corners of one closed line, x and y in m; the last is joined to the first, whether or not it repeats it.
using Outline = std::vector<std::array<double, 2>>;

/// From z = 0 to `height`. What lies within an even number of outlines is a hole. Throws std::runtime_error
/// that says why for lines that cross, fewer than 3 corners or more than 1000, and numbers that are none.
Shape drawn_up(const std::vector<Outline>& outlines, double height);

}  // namespace echoloop::worlds
