#include "render/fan/focus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "render/simd.h"

namespace echoloop {
namespace {

/// Directions along a line of a view: upwards by (base + y up) over the root of square + y^2.
struct FocusLine {
    float base, up, square, top, step;
};

/// Where in the table each pixel is.
ECHOLOOP_SIMD
void find_focus_places(const FocusLine line, const RayTable::FocusTable table, const Pixel* __restrict pixels,
                       int count, std::int32_t* __restrict place) {
    for (int i = 0; i < count; ++i) {
        const float y = line.top - static_cast<float>(i) * line.step;
        const float up = (line.base + y * line.up) / std::sqrt(line.square + y * y);
        place[i] = table.place(up, pixels[i].range);
    }
}

/// One by one, which is quicker than what g++ makes of it in vectors. Where nothing is seen any will do.
#ifdef ECHOLOOP_SIMD_VERSIONS
__attribute__((optimize("no-tree-vectorize")))
#endif
void fetch_focus(const float* all, const std::int32_t* place, int count, float* focus) {
    for (int i = 0; i < count; ++i) focus[i] = all[place[i]];
}

void find_focus(const FocusLine& line, const RayTable::FocusTable& table, const Pixel* pixels, int count,
                float* focus) {
    constexpr int at_once = 128;
    std::array<std::int32_t, at_once> place;
    FocusLine from = line;
    for (int i = 0; i < count; i += at_once) {
        const int these = std::min(at_once, count - i);
        from.top = line.top - static_cast<float>(i) * line.step;
        find_focus_places(from, table, pixels + i, these, place.data());
        fetch_focus(table.all(), place.data(), these, focus + i);
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
            find_focus({ahead + x * starboard, up, 1 + x * x, top, step}, table, &pixels[first],
                       static_cast<int>(view.samples), &focus[first]);
        }
    }
}

}  // namespace echoloop
