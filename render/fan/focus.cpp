#include "render/fan/focus.h"

#include <cmath>

#include "render/simd.h"

namespace echoloop {
namespace {

/// Directions along a line of a view: upwards by (base + y up) over the root of square + y^2.
struct FocusLine {
    float base, up, square, top, step;
};

ECHOLOOP_SIMD
void find_focus(const FocusLine line, const RayTable::FocusTable table, const float* __restrict all,
                const Pixel* __restrict pixels, int count, float* __restrict focus) {
    for (int i = 0; i < count; ++i) {
        const float y = line.top - static_cast<float>(i) * line.step;
        const float up = (line.base + y * line.up) / std::sqrt(line.square + y * y);
        const float found = all[table.place(up, pixels[i].range)];
        focus[i] = pixels[i].surface == 0 ? 1.0F : found;
    }
}

}  // namespace

void find_focus(const Picture& picture, const SampleOffsets& offset, const Pose& world_from_fan,
                const RayTable& rays, std::span<const Pixel> pixels, std::vector<float>& focus) {
    focus.resize(picture.image_lines * picture.samples);
    const RayTable::FocusTable table = rays.focus_table();
    for (const View& view : picture.views) {
        const Quat q = world_from_fan.orientation * view.fan_from_view();
        const auto up_of = [&](Vec3 axis) { return static_cast<float>(rotate(q, axis).z); };
        const float ahead = up_of({1, 0, 0}), starboard = up_of({0, -1, 0}), up = up_of({0, 0, 1});
        const PixelOffset moved = offset.of(view);
        const auto top = static_cast<float>(view.y(0.5 + moved.sample)),
                   step = static_cast<float>(view.sample_height());
        for (std::size_t line = 0; line < view.lines; ++line) {
            const auto x = static_cast<float>(view.x(static_cast<double>(line) + 0.5 + moved.line));
            const std::size_t first = (view.first_line + line) * picture.samples;
            find_focus({ahead + x * starboard, up, 1 + x * x, top, step}, table, table.all(), &pixels[first],
                       static_cast<int>(view.samples), &focus[first]);
        }
    }
}

}  // namespace echoloop
