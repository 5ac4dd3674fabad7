#include "render/renderer_channels.h"

#include <limits>

namespace echoloop {

ChannelImage channels_of(const FanPlan& plan, std::span<const Pixel> pixels) {
    ChannelImage image{plan.lines, plan.samples, {}, {}, {}};
    for (std::size_t sample = 0; sample < plan.samples; ++sample)
        for (std::size_t line = 0; line < plan.lines; ++line) {
            const Pixel& pixel = pixels[line * plan.samples + sample];
            const View& view = plan.view_of(line);
            const SampleRange nominal = plan.nominal[line];
            const bool seen = pixel.surface != 0 && sample >= nominal.first && sample < nominal.last;
            image.intensity.push_back(seen ? pixel.cosine : 0);
            image.range.push_back(seen ? pixel.range : std::numeric_limits<float>::quiet_NaN());
            image.bearing.push_back(
                static_cast<float>(view.bearing_at(static_cast<double>(line - view.first_line) + 0.5)));
        }
    return image;
}

}  // namespace echoloop
