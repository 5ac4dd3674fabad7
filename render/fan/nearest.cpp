#include "render/fan/nearest.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace echoloop {
namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();

/// Nearest range of a line among the pixels within the fan's nominal height.
float nearest_of_line(const FanPlan& plan, std::span<const Pixel> pixels, std::size_t line) {
    float nearest = nothing;
    for (std::size_t i = plan.nominal[line].first; i < plan.nominal[line].last; ++i) {
        const Pixel& pixel = pixels[line * plan.samples + i];
        nearest = std::min(nearest, pixel.surface != 0 ? pixel.range : nothing);
    }
    return nearest;
}

}  // namespace

void find_nearest_of_fan(const BinningInput& in, std::span<BeamTruth> truth) {
    std::vector<float> lines(in.plan.lines);
    for (std::size_t line = 0; line < in.plan.lines; ++line)
        lines[line] = nearest_of_line(in.plan, in.pixels, line);
    for (std::size_t beam = 0; beam < truth.size(); ++beam) {
        const BeamLines& own = in.plan.beams[beam];
        float nearest = nothing;
        for (std::size_t i = 0; i < own.nominal_lines; ++i)
            nearest = std::min(nearest, lines[own.first_nominal + i]);
        if (nearest < nothing) truth[beam].nearest_range = nearest;
    }
}

}  // namespace echoloop
