#include "render/grid/nearest.h"

namespace echoloop {

/// Of the pixels that a beam hears within its nominal size.
void find_nearest_of_grid(const BinningInput& in, const GridPlan& plan, std::span<BeamTruth> truth) {
    constexpr auto nominal =
        static_cast<std::uint16_t>(0.4F * whole_share);  // -3 dB across and upwards, or so
    for (const View& view : plan.field_views())
        for (std::size_t i = 0; i < view.lines * view.samples; ++i) {
            const std::size_t line = view.first_line + i / view.samples;
            const Pixel& pixel = in.pixels[line * plan.samples + i % view.samples];
            if (pixel.surface == 0) continue;
            for (const Heard& heard : plan.heard_by(view.first_pixel + i)) {
                float& nearest = truth[heard.beam].nearest_range;
                if (heard.share > nominal && !(nearest <= pixel.range))
                    nearest = pixel.range;  // also for NaN
            }
        }
}

}  // namespace echoloop
