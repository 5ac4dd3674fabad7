#include "tools/draw/chart.h"

#include <cmath>
#include <numbers>

#include "tools/draw/canvas.h"
#include "tools/draw/palette.h"
#include "tools/draw/ticks.h"

namespace echoloop::draw {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int margin_left = 70, margin_right = 150, margin_top = 120, margin_bottom = 50;
constexpr double line_width = 1.5;

struct Box {
    double left = 0, right = 0, top = 0, bottom = 0;  // unit circle, y down, always holds the centre
    void hold(double bearing) {
        left = std::min(left, std::sin(bearing));
        right = std::max(right, std::sin(bearing));
        top = std::min(top, -std::cos(bearing));
        bottom = std::max(bottom, -std::cos(bearing));
    }
};

Box bounds(const PolarScan& scan) {
    Box box;
    box.hold(scan.begin());
    box.hold(scan.end());
    for (double b = -2 * pi; b < 6 * pi; b += pi / 2)
        if (b > scan.begin() && b < scan.end()) box.hold(b);
    return box;
}

/// Whole degrees between the rays: at most 13 labels, and none that touch.
double bearing_step(const Chart& chart, const PolarScan& scan) {
    for (const double degrees : {1, 2, 5, 10, 15, 30}) {
        const double step = deg_to_rad(degrees);
        if (scan.end() - scan.begin() <= 13 * step && step * scan.max_range() * chart.scale >= 70)
            return step;
    }
    return deg_to_rad(45);
}

Point place(const Chart& chart, double range, double bearing) {
    return {chart.center_x + range * chart.scale * std::sin(bearing),
            chart.center_y - range * chart.scale * std::cos(bearing)};
}

/// Of a full turn, its last is not its first again.
std::vector<double> ray_bearings(const Chart& chart, const PolarScan& scan) {
    const double step = bearing_step(chart, scan);
    return ticks(scan.begin(), scan.full_turn() ? scan.end() - step / 2 : scan.end(), step);
}

std::vector<double> ring_ranges(const PolarScan& scan) {
    const double step = round_step(scan.max_range(), 5);
    return ticks(step, scan.max_range() * 0.999, step);
}

void draw_lines(Canvas& canvas, const Chart& chart, const PolarScan& scan) {
    const double range = scan.max_range();
    const auto arc = [&](double radius, double alpha) {
        canvas.arc({chart.center_x, chart.center_y}, radius * chart.scale, scan.begin(), scan.end(),
                   line_width, grid_ink, alpha);
    };
    const auto ray = [&](double bearing, double first, double alpha) {
        canvas.line({place(chart, first, bearing), place(chart, range, bearing)}, line_width, grid_ink,
                    alpha);
    };
    for (const double ring : ring_ranges(scan)) arc(ring, 0.38);
    for (const double bearing : ray_bearings(chart, scan)) ray(bearing, 0.04 * range, 0.22);
    arc(range, 0.9);
    if (scan.full_turn()) return;
    for (const double edge : {scan.begin(), scan.end()}) ray(edge, 0, 0.5);
}

/// Writes a label whose near side is `gap` px from a place, in the direction (nx, ny).
void label_beside(Canvas& canvas, Point from, double nx, double ny, double gap, const std::string& text,
                  Color color) {
    const double reach = gap + std::abs(nx) * canvas.text_width(text, text_size) / 2 +
                         std::abs(ny) * capital_height(text_size) / 2;
    canvas.text({from.x + nx * reach, from.y + ny * reach}, text, color, text_size, Anchor::middle);
}

void label_ranges(Canvas& canvas, const Chart& chart, const PolarScan& scan) {
    const double edge = scan.full_turn() ? 0 : scan.end();
    for (const double range : ring_ranges(scan)) {
        Point at = place(chart, range, edge);
        if (scan.full_turn()) at.y += 14;
        label_beside(canvas, at, std::cos(edge), std::sin(edge), 7, tick_label(range) + " m", ink);
    }
}

void label_bearings(Canvas& canvas, const Chart& chart, const PolarScan& scan) {
    for (const double b : ray_bearings(chart, scan)) {
        const double degrees = std::abs(rad_to_deg(std::remainder(b, 2 * pi)));
        const bool port = std::sin(b) < -1e-9;
        label_beside(canvas, place(chart, scan.max_range(), b), std::sin(b), -std::cos(b), 10,
                     (port ? "-" : "") + tick_label(degrees) + "\u00B0", faint_ink);
    }
}

}  // namespace

Chart Chart::fit(const PolarScan& scan, int width) {
    const Box box = bounds(scan);
    const double plot_width = width - margin_left - margin_right;
    const double scale = std::min(plot_width / (box.right - box.left), plot_width / (box.bottom - box.top));
    Chart chart;
    chart.width = width;
    chart.height = static_cast<int>(std::ceil(scale * (box.bottom - box.top))) + margin_top + margin_bottom;
    chart.scale = scale / scan.max_range();
    chart.center_x = margin_left + (plot_width - scale * (box.right - box.left)) / 2 - scale * box.left;
    chart.center_y = margin_top - scale * box.top;
    chart.left = static_cast<int>(chart.center_x + scale * box.left);
    chart.right = static_cast<int>(chart.center_x + scale * box.right) + 1;
    chart.top = margin_top;
    chart.bottom = chart.height - margin_bottom;
    return chart;
}

void draw_grid(Canvas& canvas, const Chart& chart, const PolarScan& scan) {
    draw_lines(canvas, chart, scan);
    label_ranges(canvas, chart, scan);
    label_bearings(canvas, chart, scan);
}

void draw_legend(Canvas& canvas, const Chart& chart, const Legend& legend) {
    const bool fits = canvas.text_width(legend.title, title_size) <= chart.width - 48;
    canvas.text({24, 26}, legend.title, ink, fits ? title_size : text_size);
    canvas.text({24, 58}, legend.subtitle, faint_ink, text_size);
    const int left = chart.width - 82, top = margin_top,
              length = std::min(320, chart.height - margin_top - 40);
    for (int y = 0; y < length; ++y)  // under the next, so that none shows a seam at another size
        canvas.rectangle({1.0 * left, 1.0 * top + y}, 18, y + 1 < length ? 2 : 1,
                         palette(1 - (y + 0.5) / length));
    for (const double v : ticks(legend.bottom, legend.top, legend.label_step)) {
        const double part = (legend.top - v) / (legend.top - legend.bottom);
        const double y = top + std::round(part * (length - 1));
        canvas.rectangle({left + 18.0, y}, 6, 1, faint_ink);
        canvas.text({left + 28.0, y}, tick_label(v), ink, text_size);
    }
    canvas.text({chart.width - 16.0, 88}, legend.unit, faint_ink, text_size, Anchor::right);
}

}  // namespace echoloop::draw
