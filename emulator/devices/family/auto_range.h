// The range of a sounder that follows the bottom. A pure function.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace echoloop::echosounder {

/// m of the next ping: as it is while the bottom lies between two and four fifths of it, else half as far
/// again as the bottom, in whole metres; twice as far where there is no bottom.
inline double next_range(double range, std::optional<double> bottom, double shortest, double longest) {
    if (!bottom) return std::clamp(2 * range, shortest, longest);
    if (*bottom >= range * 0.4 && *bottom <= range * 0.8) return range;
    return std::clamp(std::ceil(*bottom * 1.5), shortest, longest);
}

}  // namespace echoloop::echosounder
