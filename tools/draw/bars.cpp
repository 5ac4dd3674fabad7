#include "tools/draw/bars.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "tools/draw/canvas.h"
#include "tools/draw/palette.h"
#include "tools/draw/ticks.h"

namespace echoloop::draw {
namespace {

constexpr int above_bars = 84, below_bars = 66, bar_row = 26, bar_thickness = 16;  ///< px
constexpr std::array<Color, 6> part_colors{
    {{240, 170, 60}, {110, 190, 250}, {150, 220, 130}, {235, 130, 150}, {190, 160, 240}, {215, 215, 150}}};

double length_of(const Bar& bar) { return std::accumulate(bar.parts.begin(), bar.parts.end(), 0.0); }

std::string value_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

/// From the data's unit to px.
struct Ruler {
    double left = 0, right = 0, top = 0;

    double at(double value) const { return left + std::min(value / top, 1.0) * (right - left); }
};

Ruler ruler_of(Canvas& canvas, const Bars& bars, int width) {
    Ruler ruler;
    for (const Bar& bar : bars.bars) {
        ruler.left = std::max(ruler.left, 40 + canvas.text_width(bar.label, text_size));
        ruler.top = std::max({ruler.top, length_of(bar), bar.mark.value_or(0)});
    }
    ruler.left = std::min(ruler.left, width * 0.5);
    ruler.right = width - 90.0;
    return ruler;
}

void draw_axis(Canvas& canvas, const Bars& bars, const Ruler& ruler, double bottom) {
    for (const double value : ticks(0, ruler.top, round_step(ruler.top, 8))) {
        const double x = std::floor(ruler.at(value)) + 0.5;
        canvas.line({{x, above_bars}, {x, bottom}}, 1, grid_ink, 0.3);
        canvas.text({x, bottom + 16}, tick_label(value), ink, text_size, Anchor::middle);
    }
    canvas.text({ruler.right, bottom + 44}, bars.axis, faint_ink, text_size, Anchor::right);
}

void draw_bar(Canvas& canvas, const Bar& bar, const Ruler& ruler, double middle) {
    canvas.text({ruler.left - 12, middle}, bar.label, ink, text_size, Anchor::right);
    double begin = 0;
    for (std::size_t i = 0; i < bar.parts.size(); ++i) {
        const double from = ruler.at(begin), to = ruler.at(begin += bar.parts[i]);
        canvas.rectangle({from, middle - bar_thickness / 2.0}, to - from, bar_thickness,
                         part_colors[i % part_colors.size()]);
    }
    if (bar.mark) {
        const double x = ruler.at(*bar.mark);
        canvas.line({{x, middle - bar_row / 2.0}, {x, middle + bar_row / 2.0}}, 2.5, ink);
    }
    const double end = ruler.at(std::max(begin, bar.mark.value_or(0)));
    canvas.text({end + 8, middle}, value_text(begin), faint_ink, text_size);
}

void draw_key(Canvas& canvas, const Bars& bars) {
    double x = 24;
    for (std::size_t i = 0; i < bars.parts.size(); ++i) {
        canvas.rectangle({x, 50}, 14, 14, part_colors[i % part_colors.size()]);
        canvas.text({x + 20, 57}, bars.parts[i], ink, text_size);
        x += 20 + canvas.text_width(bars.parts[i], text_size) + 24;
    }
    if (bars.mark.empty()) return;
    canvas.line({{x + 7, 48}, {x + 7, 66}}, 2.5, ink);
    canvas.text({x + 20, 57}, bars.mark, ink, text_size);
}

}  // namespace

Picture bars_picture(const Bars& bars, int width) {
    if (std::ranges::none_of(bars.bars, [](const Bar& bar) { return length_of(bar) > 0; }))
        throw std::invalid_argument("bars: none has a length");
    const int bottom = above_bars + bar_row * static_cast<int>(bars.bars.size());
    return {Image(width, bottom + below_bars, background), [=](Canvas& canvas) {
                const Ruler ruler = ruler_of(canvas, bars, width);
                canvas.text({24, 24}, bars.title, ink, title_size);
                draw_key(canvas, bars);
                draw_axis(canvas, bars, ruler, bottom);
                for (std::size_t i = 0; i < bars.bars.size(); ++i)
                    draw_bar(canvas, bars.bars[i], ruler,
                             above_bars + bar_row * (static_cast<double>(i) + 0.5));
            }};
}

}  // namespace echoloop::draw
