#pragma once

#include <cmath>
#include <numbers>

namespace echoloop {

/// sin(pi u) / (pi u)
inline double sinc(double u) {
    const double x = std::numbers::pi * u;
    return std::abs(x) < 1e-9 ? 1 : std::sin(x) / x;
}

}  // namespace echoloop
