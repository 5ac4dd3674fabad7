#include "render/gl/picture_check.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "render/gl/scene_drawer.h"

namespace echoloop::gl {
namespace {

constexpr double far_wall = 10, near_wall = 5;  // m ahead
constexpr float least = 1e-4F;                  // relative; 32-bit floats are a hundred times better

/// A wall `ahead` that fills the view to starboard of `port` (on the image plane, to port positive).
Mesh wall(const char* name, double ahead, double port) {
    const double high = ahead, left = port * ahead, right = -ahead;
    Mesh mesh;
    mesh.object = name;
    mesh.material.name = name;
    mesh.positions = {{ahead, left, -high}, {ahead, left, high}, {ahead, right, high}, {ahead, right, -high}};
    mesh.indices = {0, 2, 1, 0, 3, 2};  // seen from the origin counter-clockwise
    return mesh;
}

Picture picture_of_one_view() {
    View view;
    view.left = view.bottom = -0.5, view.right = view.top = 0.5;
    view.lines = 32, view.samples = 48;
    return {{view}, view.lines, view.samples};
}

/// What pixel `line`, `sample` shows of a wall across the axis, `ahead` m away: R = ahead L, L = |(x, y, 1)|.
Pixel expected(const View& view, std::size_t line, std::size_t sample) {
    const double x = view.x(static_cast<double>(line) + 0.5), y = view.y(static_cast<double>(sample) + 0.5);
    const double ahead = x > 0 ? near_wall : far_wall, length = std::sqrt(1 + x * x + y * y);
    const double across = ahead * std::abs(x) / length * view.line_width(),
                 along = ahead * std::abs(y) / length * view.sample_height();
    return {static_cast<float>(ahead * length), static_cast<float>(1 / length),
            static_cast<float>(along >= across ? along : -across), x > 0 ? 2.0F : 1.0F};
}

void compare(const char* what, float is, float should_be, std::size_t line, std::size_t sample) {
    if (std::abs(is - should_be) <= least * std::max(1.0F, std::abs(should_be))) return;
    throw std::runtime_error("it draws a known picture wrongly: " + std::string(what) + " " +
                             std::to_string(is) + " instead of " + std::to_string(should_be) + " at line " +
                             std::to_string(line) + ", sample " + std::to_string(sample) +
                             "; try another driver for it, or the context "
                             "\"osmesa\"");
}

}  // namespace

void check_picture(std::unique_ptr<Context> context) {
    const std::vector<Mesh> walls{wall("far", far_wall, 1), wall("near", near_wall, 0)};
    const auto scene = Scene::from_meshes(walls);
    const Picture picture = picture_of_one_view();
    const View& view = picture.views.front();
    std::vector<SeenView> seen;
    find_seen(*scene, picture, {.world_from_fan = {}, .end_range = 100}, seen);
    std::vector<Pixel> image(picture.samples * picture.image_lines);
    SceneDrawer drawer(std::move(context), scene);
    const SeenView* views[] = {&seen.front()};
    drawer.draw(views, picture.samples, {}, image.data());
    for (std::size_t line = 0; line < view.lines; ++line)
        for (std::size_t sample = 0; sample < view.samples; ++sample) {
            const Pixel &is = image[line * view.samples + sample], should_be = expected(view, line, sample);
            compare("surface", is.surface, should_be.surface, line, sample);
            compare("range", is.range, should_be.range, line, sample);
            compare("cosine", is.cosine, should_be.cosine, line, sample);
            compare("footprint", is.footprint, should_be.footprint, line, sample);
        }
}

}  // namespace echoloop::gl
