#include "render/fan/truth.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

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

std::vector<BeamTruth> find_truth(const FanPlan& plan, std::span<const Pixel> pixels,
                                  std::span<const double> bearings, PixelOffset offset) {
    std::vector<float> lines(plan.lines);
    for (std::size_t line = 0; line < plan.lines; ++line) lines[line] = nearest_of_line(plan, pixels, line);
    std::vector<BeamTruth> truth(bearings.size());
    for (std::size_t beam = 0; beam < bearings.size(); ++beam) {
        const BeamLines& own = plan.beams[beam];
        float nearest = nothing;
        for (std::size_t i = 0; i < own.nominal_lines; ++i)
            nearest = std::min(nearest, lines[own.first_nominal + i]);
        truth[beam].axis_range = axis_range(plan, pixels, bearings[beam], 0, offset);
        if (nearest < nothing) truth[beam].nearest_range = nearest;
    }
    return truth;
}

}  // namespace echoloop
