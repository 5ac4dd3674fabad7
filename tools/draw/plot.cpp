#include "tools/draw/plot.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "tools/draw/chart.h"
#include "tools/draw/font.h"
#include "tools/draw/number.h"
#include "tools/draw/palette.h"

namespace echoloop::draw {
namespace {

constexpr int left = 90, right = 30, above = 70, below = 70;
constexpr std::array<Color, 4> colors{{{240, 170, 60}, {110, 190, 250}, {150, 220, 130}, {235, 130, 150}}};

/// From the data's units to pixels.
class Axes {
  public:
    Axes(const Plot& plot, int width, int height)
        : width_(width), height_(height), bottom_(plot.bottom), top_(plot.top) {
        for (const Curve& curve : plot.curves)
            for (const auto& [x, y] : curve.points) begin_ = std::min(begin_, x), end_ = std::max(end_, x);
        if (!(end_ > begin_) || !(top_ > bottom_)) throw std::invalid_argument("plot: an axis has no extent");
    }

    double x(double value) const {
        return left + (value - begin_) / (end_ - begin_) * (width_ - left - right);
    }
    double y(double value) const {
        return above + (top_ - value) / (top_ - bottom_) * (height_ - above - below);
    }
    bool holds(double value) const { return value >= bottom_ && value <= top_; }

    void draw(Image& image) const {
        for (int px = left; px <= width_ - right; ++px) image.blend(px, height_ - below, faint_ink);
        for (int py = above; py <= height_ - below; ++py) image.blend(left, py, faint_ink);
        const double x_step = round_step(end_ - begin_, 8), y_step = round_step(top_ - bottom_, 6);
        for (double v = std::ceil(begin_ / x_step) * x_step; v <= end_ + 1e-9; v += x_step) draw_x(image, v);
        for (double v = std::ceil(bottom_ / y_step) * y_step; v <= top_ + 1e-9; v += y_step) draw_y(image, v);
    }

  private:
    void draw_x(Image& image, double value) const {
        const int px = static_cast<int>(x(value));
        for (int py = above; py <= height_ - below; ++py) image.blend(px, py, grid_ink, 0.22);
        draw_text(image, px, height_ - below + 18, number(value), ink, 2, Anchor::middle);
    }
    void draw_y(Image& image, double value) const {
        const int py = static_cast<int>(y(value));
        for (int px = left; px <= width_ - right; ++px) image.blend(px, py, grid_ink, 0.22);
        draw_text(image, left - 8, py, number(value), ink, 2, Anchor::right);
    }

    int width_, height_;
    double bottom_, top_;
    double begin_ = std::numeric_limits<double>::infinity(), end_ = -begin_;
};

void draw_dot(Image& image, double x, double y, Color color) {
    for (int dy = -4; dy <= 4; ++dy)
        for (int dx = -4; dx <= 4; ++dx)
            image.blend(static_cast<int>(x) + dx, static_cast<int>(y) + dy, color,
                        std::clamp(3.4 - std::hypot(dx, dy), 0.0, 1.0));
}

void draw_line(Image& image, double x0, double y0, double x1, double y1, Color color) {
    const double steps = std::ceil(2 * std::max({std::abs(x1 - x0), std::abs(y1 - y0), 0.5}));
    for (double k = 0; k <= steps; ++k) {
        const double x = x0 + (x1 - x0) * k / steps, y = y0 + (y1 - y0) * k / steps;
        for (const int beside : {0, 1})
            image.blend(static_cast<int>(x), static_cast<int>(y) + beside, color, 0.8);
    }
}

void draw_curve(Image& image, const Axes& axes, const Curve& curve, Color color) {
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const auto [x, y] = curve.points[i];
        if (!axes.holds(y)) continue;
        if (curve.dots) {
            draw_dot(image, axes.x(x), axes.y(y), color);
        } else if (i > 0 && axes.holds(curve.points[i - 1].second)) {
            draw_line(image, axes.x(curve.points[i - 1].first), axes.y(curve.points[i - 1].second), axes.x(x),
                      axes.y(y), color);
        }
    }
}

}  // namespace

Image plot_picture(const Plot& plot, int width, int height) {
    Image image(width, height, background);
    const Axes axes(plot, width, height);
    axes.draw(image);
    draw_text(image, 24, 24, plot.title, ink, 3);
    draw_text(image, 24, 52, plot.y_label, faint_ink);
    draw_text(image, width - right, height - 22, plot.x_label, faint_ink, 2, Anchor::right);
    int legend = left;
    for (std::size_t i = 0; i < plot.curves.size(); ++i) {
        const Color color = colors[i % colors.size()];
        draw_curve(image, axes, plot.curves[i], color);
        draw_text(image, legend, height - 22, plot.curves[i].label, color);
        legend += text_width(plot.curves[i].label, 2) + 30;
    }
    return image;
}

}  // namespace echoloop::draw
