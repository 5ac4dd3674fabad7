// Lines and text on an image, drawn by cairo. Knows no axis and no sonar.
#pragma once

#include <cairo.h>

#include <memory>
#include <string>
#include <vector>

#include "tools/draw/image.h"

namespace echoloop::draw {

constexpr double text_size = 16, title_size = 22;  ///< px
/// Height of a capital letter, px.
constexpr double capital_height(double size) { return 0.73 * size; }

enum class Anchor { left, middle, right };

struct Point {
    double x = 0, y = 0;  ///< px from the image's left and upper edge
};

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

/// The pixels of an image as cairo sees them; the image must outlive it.
Surface surface_of(Image& image);

/// Draws on an image, which must outlive it; what lies outside is left out. Lengths are px.
class Canvas {
  public:
    explicit Canvas(Image& image);
    /// On any surface, which must outlive it.
    explicit Canvas(cairo_surface_t* surface);

    /// The pixels of an image, its upper left corner at the surface's.
    void image(const Image& image);
    void rectangle(Point corner, double width, double height, Color color);
    void dot(Point center, double radius, Color color);
    /// A line through all points.
    void line(const std::vector<Point>& points, double width, Color color, double alpha = 1);
    /// Part of a circle between two bearings: rad, 0 upwards, clockwise.
    void arc(Point center, double radius, double begin, double end, double width, Color color, double alpha);

    /// One line of text. `place.y` is the middle of its capital letters, `place.x` its left end, middle or
    /// right end as `anchor` says; `size` is the font's. In a text that is not UTF-8, all but ASCII becomes
    /// "?".
    void text(Point place, const std::string& text, Color color, double size, Anchor anchor = Anchor::left);
    double text_width(const std::string& text, double size);

  private:
    void set_source(Color color, double alpha = 1);
    void stroke(double width, Color color, double alpha);

    Context cairo_;
};

}  // namespace echoloop::draw
