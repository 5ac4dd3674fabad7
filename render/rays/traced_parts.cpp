#include "render/rays/traced_parts.h"

namespace echoloop::rays {

ViewPlace::ViewPlace(const View& view, const gl::Outlook& outlook) {
    const Quat q = outlook.world_from_fan.orientation * view.fan_from_view();
    const auto set = [](Vec3 v, float* to) {
        to[0] = static_cast<float>(v.x), to[1] = static_cast<float>(v.y), to[2] = static_cast<float>(v.z);
    };
    set(rotate(q, {0, -1, 0}), axes.starboard);
    set(rotate(q, {0, 0, 1}), axes.up);
    set(rotate(q, {1, 0, 0}), axes.forward);
    set(outlook.world_from_fan.position, eye.data());
    sizes = {static_cast<float>(view.line_width()), static_cast<float>(view.sample_height()),
             static_cast<float>(view.usual_width), static_cast<float>(view.usual_height)};
    const double moved = outlook.offset.of(view).sample;
    for (std::size_t sample = 0; sample < view.samples + tile_samples; ++sample)
        y.push_back(static_cast<float>(view.y(static_cast<double>(sample) + 0.5 + moved)));
}

}  // namespace echoloop::rays
