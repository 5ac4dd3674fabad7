#include "render/fan/focus.h"

#include <cmath>

namespace echoloop {

void find_focus(const Picture& picture, const SampleOffsets& offset, const Pose& world_from_fan,
                const RayTable& rays, std::span<const Pixel> pixels, std::vector<float>& focus) {
    focus.resize(picture.image_lines * picture.samples);
    for (const View& view : picture.views) {
        const Quat q = world_from_fan.orientation * view.fan_from_view();
        const auto up_of = [&](Vec3 axis) { return static_cast<float>(rotate(q, axis).z); };
        const float ahead = up_of({1, 0, 0}), starboard = up_of({0, -1, 0}), up = up_of({0, 0, 1});
        const PixelOffset moved = offset.of(view);
        const auto top = static_cast<float>(view.y(0.5 + moved.sample)),
                   step = static_cast<float>(view.sample_height());
        for (std::size_t line = 0; line < view.lines; ++line) {
            const auto x = static_cast<float>(view.x(static_cast<double>(line) + 0.5 + moved.line));
            const float base = ahead + x * starboard, square = 1 + x * x;
            const std::size_t first = (view.first_line + line) * picture.samples;
            for (std::size_t i = 0; i < view.samples; ++i) {
                const Pixel& pixel = pixels[first + i];
                const float y = top - static_cast<float>(i) * step;
                focus[first + i] = pixel.surface == 0
                                       ? 1.0F
                                       : rays.focus((base + y * up) / std::sqrt(square + y * y), pixel.range);
            }
        }
    }
}

}  // namespace echoloop
