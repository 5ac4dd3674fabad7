#include "tools/draw/chart.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tools/draw/font.h"
#include "tools/draw/number.h"
#include "tools/draw/palette.h"

namespace echoloop::draw {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int margin_left = 70, margin_right = 150, margin_top = 120, margin_bottom = 50;

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

/// Share of a line one and a half px thick that covers a pixel `distance` px away.
double coverage(double distance) { return std::clamp(1.25 - std::abs(distance), 0.0, 1.0); }

double nearest(double value, double step) { return std::round(value / step) * step; }

/// Whole degrees between the rays: at most 13 labels, and none that touch.
double bearing_step(const Chart& chart, const PolarScan& scan) {
    for (const double degrees : {1, 2, 5, 10, 15, 30}) {
        const double step = deg_to_rad(degrees);
        if (scan.end() - scan.begin() <= 13 * step && step * scan.max_range() * chart.scale >= 70)
            return step;
    }
    return deg_to_rad(45);
}

/// Rings, rays and the outline of the sector.
struct Grid {
    double ring_step, ray_step, scale, max_range;

    Grid(const Chart& chart, const PolarScan& scan)
        : ring_step(round_step(scan.max_range(), 5)),
          ray_step(bearing_step(chart, scan)),
          scale(chart.scale),
          max_range(scan.max_range()) {}

    /// How strongly the grid shows at a place in m and rad.
    double strength(double range, double bearing) const {
        const double outside = (range - max_range) * scale;
        double result = 0.9 * coverage(outside);
        if (outside > 1) return result;
        const double ring = nearest(range, ring_step);
        if (ring > 0) result = std::max(result, 0.38 * coverage((range - ring) * scale));
        const double aside = range * std::sin(bearing - nearest(bearing, ray_step));
        if (range > 0.04 * max_range) result = std::max(result, 0.22 * coverage(aside * scale));
        return result;
    }
};

void draw_lines(Image& image, const Chart& chart, const PolarScan& scan) {
    const Grid grid(chart, scan);
    for (int y = chart.top - 2; y <= chart.bottom + 2; ++y)
        for (int x = chart.left - 2; x <= chart.right + 2; ++x) {
            const double dx = (x + 0.5 - chart.center_x) / chart.scale;
            const double dy = (y + 0.5 - chart.center_y) / chart.scale;
            const double bearing = std::atan2(dx, -dy);
            const double strength = grid.strength(std::hypot(dx, dy), bearing);
            if (strength > 0 && scan.covers(bearing)) image.blend(x, y, grid_ink, strength);
        }
}

void draw_edge(Image& image, const Chart& chart, double bearing, double range) {
    const int steps = static_cast<int>(range * chart.scale * 2);
    for (int k = 0; k < steps; ++k) {
        const double r = k * 0.5;
        image.blend(static_cast<int>(std::floor(chart.center_x + r * std::sin(bearing))),
                    static_cast<int>(std::floor(chart.center_y - r * std::cos(bearing))), grid_ink, 0.5);
    }
}

/// Writes a label whose near side is `gap` px from a place, in the direction (nx, ny).
void label_beside(Image& image, double x, double y, double nx, double ny, double gap, const std::string& text,
                  Color color) {
    const double reach = gap + std::abs(nx) * text_width(text, 2) / 2 + std::abs(ny) * text_height(2) / 2;
    draw_text(image, static_cast<int>(x + nx * reach), static_cast<int>(y + ny * reach), text, color, 2,
              Anchor::middle);
}

void label_ranges(Image& image, const Chart& chart, const PolarScan& scan) {
    const double step = round_step(scan.max_range(), 5);
    const double edge = scan.full_turn() ? 0 : scan.end();
    for (double r = step; r < scan.max_range() * 0.999; r += step) {
        const double x = chart.center_x + r * chart.scale * std::sin(edge);
        const double y = chart.center_y - r * chart.scale * std::cos(edge) + (scan.full_turn() ? 14 : 0);
        label_beside(image, x, y, std::cos(edge), std::sin(edge), 7, number(r) + " m", ink);
    }
}

void label_bearings(Image& image, const Chart& chart, const PolarScan& scan) {
    const double step = bearing_step(chart, scan), tolerance = 1e-9, r = scan.max_range() * chart.scale;
    const double last = scan.full_turn() ? scan.end() - step / 2 : scan.end() + tolerance;
    for (double b = std::ceil(scan.begin() / step - tolerance) * step; b <= last; b += step) {
        const double degrees = std::abs(rad_to_deg(std::remainder(b, 2 * pi)));
        const bool port = std::sin(b) < -1e-9;
        label_beside(image, chart.center_x + r * std::sin(b), chart.center_y - r * std::cos(b), std::sin(b),
                     -std::cos(b), 10, (port ? "-" : "") + number(degrees) + "\u00B0", faint_ink);
    }
}

}  // namespace

double round_step(double length, double parts) {
    const double power = std::pow(10, std::floor(std::log10(length / parts)));
    for (const double factor : {1, 2, 5})
        if (length / (factor * power) <= parts * 1.3) return factor * power;
    return 10 * power;
}

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

void draw_grid(Image& image, const Chart& chart, const PolarScan& scan) {
    draw_lines(image, chart, scan);
    if (!scan.full_turn())
        for (const double edge : {scan.begin(), scan.end()}) draw_edge(image, chart, edge, scan.max_range());
    label_ranges(image, chart, scan);
    label_bearings(image, chart, scan);
}

void draw_legend(Image& image, const Chart& chart, const Legend& legend) {
    const bool fits = text_width(legend.title, 3) <= chart.width - 48;
    draw_text(image, 24, 26, legend.title, ink, fits ? 3 : 2);
    draw_text(image, 24, 58, legend.subtitle, faint_ink);
    const int left = chart.width - 82, top = margin_top,
              length = std::min(320, chart.height - margin_top - 40);
    for (int y = 0; y < length; ++y)
        for (int x = 0; x < 18; ++x) image.blend(left + x, top + y, palette(1 - (y + 0.5) / length));
    const double range = legend.top - legend.bottom;
    for (double v = std::ceil(legend.bottom / legend.label_step) * legend.label_step; v <= legend.top + 1e-9;
         v += legend.label_step) {
        const int y = top + static_cast<int>(std::lround((legend.top - v) / range * (length - 1)));
        for (int x = 18; x < 24; ++x) image.blend(left + x, y, faint_ink);
        draw_text(image, left + 28, y, number(v), ink, 2);
    }
    draw_text(image, chart.width - 16, 88, legend.unit, faint_ink, 2, Anchor::right);
}

}  // namespace echoloop::draw
