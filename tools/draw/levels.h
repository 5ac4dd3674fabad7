// From values of an echogram to shades and the colour bar that explains them, whatever the picture's form.
#pragma once

#include <cmath>
#include <cstdio>
#include <span>
#include <string>

#include "tools/draw/chart.h"
#include "tools/draw/draw.h"
#include "tools/draw/polar.h"

namespace echoloop::draw {

/// Turns a value of the echogram at a range into 0..1 of the colour scale.
struct Levels {
    EchoRule rule;
    double top, span, spreading, absorption;

    double gain(double range) const {
        return spreading * std::log10(std::max(range, 0.1)) + 2 * absorption * range;
    }
    double shade(double value, double range) const {
        if (rule == EchoRule::cerqueira2016) return value;
        if (!(value > 0)) return 0;
        return 1 + (10 * std::log10(value) + gain(range) - top) / span;
    }
};

/// With the style's top, or one that suits `rays`. Throws std::invalid_argument for a style out of bounds.
Levels levels_for(std::span<const Ray> rays, EchoRule rule, const Style& style);

Legend legend_of(const Style& style, std::string subtitle, const Levels& levels);

std::string text(const char* format, auto... values) {
    std::string result(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
    std::snprintf(result.data(), result.size() + 1, format, values...);
    return result;
}

}  // namespace echoloop::draw
