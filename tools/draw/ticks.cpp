#include "tools/draw/ticks.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace echoloop::draw {

double round_step(double length, double parts) {
    const double power = std::pow(10, std::floor(std::log10(length / parts)));
    for (const double factor : {1, 2, 5})
        if (length / (factor * power) <= parts * 1.3) return factor * power;
    return 10 * power;
}

std::vector<double> ticks(double begin, double end, double step) {
    constexpr double tolerance = 1e-9;  // of a step
    std::vector<double> all;
    for (double k = std::ceil(begin / step - tolerance); k <= end / step + tolerance; ++k)
        all.push_back(k * step);
    return all;
}

std::string tick_label(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", std::round(value * 1e6) / 1e6 + 0.0);
    return text.data();
}

}  // namespace echoloop::draw
