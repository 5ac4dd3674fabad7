#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tools/draw/chart.h"
#include "tools/draw/draw.h"
#include "tools/draw/palette.h"
#include "tools/draw/ticks.h"

namespace echoloop::draw {
namespace {

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
double automatic_top(const PolarScan& scan, const Levels& levels) {
    std::vector<double> all;
    for (const Ray& ray : scan.rays())
        for (std::size_t i = 0; i < ray.values.size(); ++i)
            if (ray.values[i] > 0 && std::isfinite(ray.values[i]))
                all.push_back(10 * std::log10(ray.values[i]) +
                              levels.gain(ray.first + static_cast<double>(i) * ray.step));
    if (all.empty()) return 0;
    const auto place = all.begin() + static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(all.size() - 1));
    std::nth_element(all.begin(), place, all.end());
    return 5 * std::ceil(*place / 5);
}

/// Mean power over a pixel, so that neither beams nor bins finer than a pixel make a moire.
double pixel_shade(const PolarScan& scan, const Chart& chart, const Levels& levels, int x, int y) {
    constexpr int samples = 3;
    double sum = 0;
    for (int j = 0; j < samples; ++j)
        for (int i = 0; i < samples; ++i) {
            const double dx = (x + (i + 0.5) / samples - chart.center_x) / chart.scale;
            const double dy = (y + (j + 0.5) / samples - chart.center_y) / chart.scale;
            sum += scan.value(std::hypot(dx, dy), std::atan2(dx, -dy), 1 / chart.scale / samples);
        }
    const double range = std::hypot(x + 0.5 - chart.center_x, y + 0.5 - chart.center_y) / chart.scale;
    return levels.shade(sum / (samples * samples), range);
}

void draw_echoes(Image& image, const Chart& chart, const PolarScan& scan, const Levels& levels) {
    for (int y = chart.top; y < chart.bottom; ++y)
        for (int x = chart.left; x < chart.right; ++x) {
            const double dx = x + 0.5 - chart.center_x, dy = y + 0.5 - chart.center_y;
            if (std::hypot(dx, dy) > scan.max_range() * chart.scale || !scan.covers(std::atan2(dx, -dy)))
                continue;
            image.at(x, y) = palette(pixel_shade(scan, chart, levels, x, y));
        }
}

std::string text(const char* format, auto... values) {
    std::string result(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
    std::snprintf(result.data(), result.size() + 1, format, values...);
    return result;
}

std::string subtitle(std::span<const Echogram> pings, const PolarScan& scan) {
    const Shot& shot = pings.front().shot;
    std::string line = text("%.3g m, %g kHz, %zu %s x %zu bins", scan.max_range(), shot.frequency / 1000,
                            scan.rays().size(), scan.rays().size() == 1 ? "beam" : "beams", shot.bins);
    if (pings.size() == 1 && shot.tilt != 0) line += text(", tilt %.1f\u00B0", rad_to_deg(shot.tilt));
    return line;
}

Legend legend(std::span<const Echogram> pings, const PolarScan& scan, const Levels& levels,
              const Style& style) {
    Legend result{style.title, subtitle(pings, scan),      levels.top - levels.span,
                  levels.top,  round_step(levels.span, 6), "dB re 1 \u00B5Pa"};
    if (levels.rule == EchoRule::cerqueira2016) return {style.title, result.subtitle, 0, 1, 0.2, "0..1"};
    if (levels.spreading > 0) result.unit += text(" + %g log r", levels.spreading);
    if (levels.absorption > 0) result.unit += text(" + %.2g r", 2 * levels.absorption);
    return result;
}

}  // namespace

Image polar_picture(std::span<const Echogram> pings, const Style& style) {
    check(style);
    const PolarScan scan(pings);
    Levels levels{pings.front().rule, 0, style.span, style.spreading, style.absorption};
    levels.top = style.top ? *style.top : automatic_top(scan, levels);
    const Chart chart = Chart::fit(scan, style.width);
    Image image(chart.width, chart.height, background);
    draw_echoes(image, chart, scan, levels);
    draw_grid(image, chart, scan);
    draw_legend(image, chart, legend(pings, scan, levels, style));
    return image;
}

}  // namespace echoloop::draw
