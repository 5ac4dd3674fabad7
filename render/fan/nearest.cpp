#include "render/fan/nearest.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "render/fan/line_echoes.h"

namespace echoloop {
namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();

}  // namespace

void find_nearest_of_fan(const BinningInput& in, std::span<BeamTruth> truth) {
    std::vector<float> lines(in.plan.lines);
    for (std::size_t line = 0; line < in.plan.lines; ++line) {
        const SampleRange& nominal = in.plan.nominal[line];  // of the fan's nominal height
        const std::size_t count = nominal.last > nominal.first ? nominal.last - nominal.first : 0;
        const Pixel* first = in.pixels.data() + line * in.plan.samples + nominal.first;
        lines[line] = nearest_range(first, count);
    }
    for (std::size_t beam = 0; beam < truth.size(); ++beam) {
        const BeamLines& own = in.plan.beams[beam];
        float nearest = nothing;
        for (std::size_t i = 0; i < own.nominal_lines; ++i)
            nearest = std::min(nearest, lines[own.first_nominal + i]);
        if (nearest < nothing) truth[beam].nearest_range = nearest;
    }
}

}  // namespace echoloop
