#include "render/fan/truth.h"

#include <algorithm>
#include <cmath>

namespace echoloop {
namespace {

/// A position between pixel centres along one axis of the image: lower neighbour and the share of the upper
/// one.
struct Between {
    std::size_t lower;
    float share;
};

Between between(double position, std::size_t count) {
    const double at = std::clamp(position - 0.5, 0.0, static_cast<double>(count - 1));
    const auto lower = std::min(static_cast<std::size_t>(at), count - 2);
    return {lower, static_cast<float>(at - static_cast<double>(lower))};
}

/// Range between four pixels of one surface; at an edge that of the nearest pixel.
float range_between(std::span<const Pixel> pixels, std::size_t samples, Between line, Between sample) {
    const Pixel* upper = &pixels[line.lower * samples + sample.lower];
    const Pixel corner[2][2] = {{upper[0], upper[1]}, {upper[samples], upper[samples + 1]}};
    const Pixel& nearest = corner[line.share > 0.5F][sample.share > 0.5F];
    for (const auto& row : corner)
        for (const Pixel& pixel : row) {
            const float step = 2 * (std::abs(pixel.footprint) + std::abs(nearest.footprint)) + 1e-3F;
            if (pixel.surface != nearest.surface || std::abs(pixel.range - nearest.range) > step)
                return nearest.surface != 0 ? nearest.range : BeamTruth{}.axis_range;
        }
    if (nearest.surface == 0) return BeamTruth{}.axis_range;
    const float left = std::lerp(corner[0][0].range, corner[0][1].range, sample.share);
    const float right = std::lerp(corner[1][0].range, corner[1][1].range, sample.share);
    return std::lerp(left, right, line.share);
}

/// m, of what stands in a direction relative to the plan's level plane; NaN: nothing.
float axis_range(const FanPlan& plan, std::span<const Pixel> pixels, double bearing, double elevation,
                 PixelOffset offset) {
    const View& view = plan.view_at(bearing);
    const double x = std::tan(bearing - view.bearing), y = std::tan(elevation) * std::sqrt(1 + x * x);
    const double line = (x - view.left) / view.line_width() - offset.line;
    const double sample = (view.top - y) / view.sample_height() - offset.sample;
    Between lines = between(line, view.lines);
    lines.lower += view.first_line;
    return range_between(pixels, plan.samples, lines, between(sample, view.samples));
}

}  // namespace

std::vector<BeamTruth> find_truth(const Summing& summing, const BinningInput& in, const Shot& shot) {
    const std::size_t columns = shot.bearings.size();
    std::vector<BeamTruth> truth(columns * shot.rows());
    for (std::size_t beam = 0; beam < truth.size(); ++beam) {
        const double elevation = shot.elevations.empty() ? 0 : shot.elevations[beam / columns];
        truth[beam].axis_range =
            axis_range(in.plan, in.pixels, shot.bearings[beam % columns], elevation, in.offset.level);
    }
    summing.find_nearest(in, truth);
    return truth;
}

}  // namespace echoloop
