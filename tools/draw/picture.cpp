#include <cmath>
#include <memory>

#include "tools/draw/levels.h"
#include "tools/draw/palette.h"

namespace echoloop::draw {
namespace {

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

std::string subtitle(std::span<const Echogram> pings, const PolarScan& scan) {
    const Shot& shot = pings.front().shot;
    std::string line = text("%.3g m, %g kHz, %zu %s x %zu bins", scan.max_range(), shot.frequency / 1000,
                            scan.rays().size(), scan.rays().size() == 1 ? "beam" : "beams", shot.bins);
    if (pings.size() == 1 && shot.tilt != 0) line += text(", tilt %.1f\u00B0", rad_to_deg(shot.tilt));
    return line;
}

}  // namespace

Picture polar_picture(std::span<const Echogram> pings, const Style& style) {
    const auto scan = std::make_shared<const PolarScan>(pings);
    const Levels levels = levels_for(scan->rays(), pings.front().rule, style);
    const Chart chart = Chart::fit(*scan, style.width);
    Image image(chart.width, chart.height, background);
    draw_echoes(image, chart, *scan, levels);
    const Legend legend = legend_of(style, subtitle(pings, *scan), levels);
    return {std::move(image), [=](Canvas& canvas) {
                draw_grid(canvas, chart, *scan);
                draw_legend(canvas, chart, legend);
            }};
}

}  // namespace echoloop::draw
