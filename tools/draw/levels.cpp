#include "tools/draw/levels.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tools/draw/ticks.h"

namespace echoloop::draw {
namespace {

void check(const Style& style) {
    const auto require = [](bool good, const char* what) {
        if (!good) throw std::invalid_argument(what);
    };
    require(style.width >= 400 && style.width <= 4000, "style.width: must be 400..4000 px");
    require(style.span >= 1 && style.span <= 200, "style.span: must be 1..200 dB");
    require(style.spreading >= 0 && style.spreading <= 60,
            "style.spreading: must be 0..60 dB per decade of range");
    require(style.absorption >= 0 && style.absorption <= 10, "style.absorption: must be 0..10 dB/m");
    require(!style.top || std::isfinite(*style.top), "style.top: must be a finite level in dB");
}

/// The displayed level that one value in a thousand exceeds, rounded up to 5 dB.
double automatic_top(std::span<const Ray> rays, const Levels& levels) {
    std::vector<double> all;
    for (const Ray& ray : rays)
        for (std::size_t i = 0; i < ray.values.size(); ++i)
            if (ray.values[i] > 0 && std::isfinite(ray.values[i]))
                all.push_back(10 * std::log10(ray.values[i]) +
                              levels.gain(ray.first + static_cast<double>(i) * ray.step));
    if (all.empty()) return 0;
    const auto place = all.begin() + static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(all.size() - 1));
    std::nth_element(all.begin(), place, all.end());
    return 5 * std::ceil(*place / 5);
}

}  // namespace

Levels levels_for(std::span<const Ray> rays, EchoRule rule, const Style& style) {
    check(style);
    Levels levels{rule, 0, style.span, style.spreading, style.absorption};
    levels.top = style.top ? *style.top : automatic_top(rays, levels);
    return levels;
}

Legend legend_of(const Style& style, std::string subtitle, const Levels& levels) {
    if (levels.rule == EchoRule::cerqueira2016) return {style.title, std::move(subtitle), 0, 1, 0.2, "0..1"};
    Legend result{style.title, std::move(subtitle),        levels.top - levels.span,
                  levels.top,  round_step(levels.span, 6), "dB re 1 \u00B5Pa"};
    if (levels.spreading > 0) result.unit += text(" + %g log r", levels.spreading);
    if (levels.absorption > 0) result.unit += text(" + %.2g r", 2 * levels.absorption);
    return result;
}

}  // namespace echoloop::draw
