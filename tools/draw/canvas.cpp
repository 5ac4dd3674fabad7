#include "tools/draw/canvas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace echoloop::draw {
namespace {

/// Without this font, fontconfig takes another. Without any, cairo has letters of its own, but no degree
/// sign.
constexpr auto font = "DejaVu Sans";

void select_font(cairo_t* cairo, double size) {
    cairo_select_font_face(cairo, font, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, size);
}

bool is_utf8(const std::string& text) {
    Image pixel(1, 1, {});
    const Surface surface = surface_of(pixel);
    const Context trial(cairo_create(surface.get()), cairo_destroy);
    cairo_text_extents_t extents;
    cairo_text_extents(trial.get(), text.c_str(), &extents);
    return cairo_status(trial.get()) == CAIRO_STATUS_SUCCESS;
}

/// After a text that is not UTF-8, cairo would draw nothing more.
std::string as_utf8(std::string text) {
    if (!is_utf8(text))
        std::replace_if(
            text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; }, '?');
    return text;
}

}  // namespace

Surface surface_of(Image& image) {
    return {cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(image.pixels.data()),
                                                CAIRO_FORMAT_RGB24, image.width, image.height,
                                                image.width * static_cast<int>(sizeof(Color))),
            cairo_surface_destroy};
}

Canvas::Canvas(Image& image) : Canvas(surface_of(image).get()) {}

Canvas::Canvas(cairo_surface_t* surface) : cairo_(cairo_create(surface), cairo_destroy) {
    const std::unique_ptr<cairo_font_options_t, decltype(&cairo_font_options_destroy)> options(
        cairo_font_options_create(), cairo_font_options_destroy);
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_SLIGHT);
    cairo_set_font_options(cairo_.get(), options.get());
}

void Canvas::set_source(Color color, double alpha) {
    cairo_set_source_rgba(cairo_.get(), color.r / 255.0, color.g / 255.0, color.b / 255.0, alpha);
}

void Canvas::image(const Image& image) {
    Image pixels = image;  // cairo takes nothing constant
    const Surface source = surface_of(pixels);
    cairo_set_source_surface(cairo_.get(), source.get(), 0, 0);
    cairo_paint(cairo_.get());
    set_source(Color());
    cairo_surface_finish(source.get());  // what draws later keeps a copy of its own
}

void Canvas::rectangle(Point corner, double width, double height, Color color) {
    set_source(color);
    cairo_rectangle(cairo_.get(), corner.x, corner.y, width, height);
    cairo_fill(cairo_.get());
}

void Canvas::dot(Point center, double radius, Color color) {
    set_source(color);
    cairo_arc(cairo_.get(), center.x, center.y, radius, 0, 2 * std::numbers::pi);
    cairo_fill(cairo_.get());
}

void Canvas::line(const std::vector<Point>& points, double width, Color color, double alpha) {
    for (const Point& p : points) cairo_line_to(cairo_.get(), p.x, p.y);
    stroke(width, color, alpha);
}

void Canvas::arc(Point center, double radius, double begin, double end, double width, Color color,
                 double alpha) {
    constexpr double upwards = std::numbers::pi / 2;  // cairo counts from the right, clockwise too
    cairo_arc(cairo_.get(), center.x, center.y, radius, begin - upwards, end - upwards);
    stroke(width, color, alpha);
}

void Canvas::stroke(double width, Color color, double alpha) {
    set_source(color, alpha);
    cairo_set_line_width(cairo_.get(), width);
    cairo_stroke(cairo_.get());
}

double Canvas::text_width(const std::string& text, double size) {
    select_font(cairo_.get(), size);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_.get(), as_utf8(text).c_str(), &extents);
    return extents.x_advance;
}

void Canvas::text(Point place, const std::string& text, Color color, double size, Anchor anchor) {
    const double width = text_width(text, size);
    const double left = anchor == Anchor::left ? 0 : anchor == Anchor::middle ? width / 2 : width;
    set_source(color);
    cairo_move_to(cairo_.get(), place.x - left, place.y + capital_height(size) / 2);
    cairo_show_text(cairo_.get(), as_utf8(text).c_str());
    cairo_new_path(cairo_.get());
}

}  // namespace echoloop::draw
