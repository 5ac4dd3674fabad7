#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace echoloop::draw {

/// As a label shows it: without the last bits of a sum.
inline std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", std::round(value * 1e6) / 1e6 + 0.0);
    return text.data();
}

}  // namespace echoloop::draw
