#include "tools/draw/plot.h"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tools/draw/canvas.h"
#include "tools/draw/palette.h"
#include "tools/draw/ticks.h"

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

    Point at(double x, double y) const {
        return {left + (x - begin_) / (end_ - begin_) * (width_ - left - right),
                above + (top_ - y) / (top_ - bottom_) * (height_ - above - below)};
    }
    bool holds(double y) const { return y >= bottom_ && y <= top_; }

    void draw(Canvas& canvas) const {
        for (const double x : ticks(begin_, end_, round_step(end_ - begin_, 8))) {
            grid_line(canvas, at(x, bottom_), at(x, top_), grid_ink, 0.3);
            const Point label{at(x, bottom_).x, height_ - below + 18.0};
            canvas.text(label, tick_label(x), ink, text_size, Anchor::middle);
        }
        for (const double y : ticks(bottom_, top_, round_step(top_ - bottom_, 6))) {
            grid_line(canvas, at(begin_, y), at(end_, y), grid_ink, 0.3);
            canvas.text({left - 8.0, at(begin_, y).y}, tick_label(y), ink, text_size, Anchor::right);
        }
        grid_line(canvas, at(begin_, bottom_), at(end_, bottom_), faint_ink, 1);
        grid_line(canvas, at(begin_, bottom_), at(begin_, top_), faint_ink, 1);
    }

  private:
    /// One px wide, on whole pixels.
    static void grid_line(Canvas& canvas, Point from, Point to, Color color, double alpha) {
        for (Point* p : {&from, &to}) *p = {std::floor(p->x) + 0.5, std::floor(p->y) + 0.5};
        canvas.line({from, to}, 1, color, alpha);
    }

    int width_, height_;
    double bottom_, top_;
    double begin_ = std::numeric_limits<double>::infinity(), end_ = -begin_;
};

void draw_curve(Canvas& canvas, const Axes& axes, const Curve& curve, Color color) {
    constexpr double radius = 3.4, width = 1.8;
    std::vector<Point> piece;  // what lies within the axes without a gap
    for (const auto& [x, y] : curve.points) {
        if (!axes.holds(y)) {
            canvas.line(piece, width, color);
            piece.clear();
        } else if (curve.dots) {
            canvas.dot(axes.at(x, y), radius, color);
        } else {
            piece.push_back(axes.at(x, y));
        }
    }
    canvas.line(piece, width, color);
}

}  // namespace

Picture plot_picture(const Plot& plot, int width, int height) {
    const Axes axes(plot, width, height);
    return {Image(width, height, background), [=](Canvas& canvas) {
                axes.draw(canvas);
                canvas.text({24, 24}, plot.title, ink, title_size);
                canvas.text({24, 52}, plot.y_label, faint_ink, text_size);
                const double lowest = height - 22;
                canvas.text({width - 1.0 * right, lowest}, plot.x_label, faint_ink, text_size, Anchor::right);
                double legend = left;
                for (std::size_t i = 0; i < plot.curves.size(); ++i) {
                    const Color color = colors[i % colors.size()];
                    draw_curve(canvas, axes, plot.curves[i], color);
                    canvas.text({legend, lowest}, plot.curves[i].label, color, text_size);
                    legend += canvas.text_width(plot.curves[i].label, text_size) + 30;
                }
            }};
}

}  // namespace echoloop::draw
