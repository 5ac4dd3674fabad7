#include "render/fan/plan.h"

#include <algorithm>
#include <cmath>

#include "render/fan/plan_parts.h"

namespace echoloop {
namespace {

constexpr double lowest_step = deg_to_rad(0.2);  ///< finer samples show nothing but finer outlines

/// Beams more than this many widths apart belong to different arrays, which need nothing drawn between them.
constexpr double widest_gap = 20;

std::vector<FanPart> split_beams(const FanGeometry& g) {
    std::vector<FanPart> parts(1);
    for (std::size_t beam = 0; beam < g.bearings.size(); ++beam) {
        if (beam > 0 && g.bearings[beam] - g.bearings[beam - 1] > std::max(widest_gap * g.beam_width, 1.0)) {
            parts.emplace_back();
            parts.back().first_beam = beam;
        }
        ++parts.back().beams;
    }
    for (FanPart& part : parts)
        part.centre = (g.bearings[part.first_beam] + g.bearings[part.first_beam + part.beams - 1]) / 2;
    return parts;
}

Lobe lobe_of(const FanGeometry& g, AxisPattern axis, double width, double edge_power) {
    return g.patterns ? Lobe::pattern(axis, width, edge_power) : Lobe::box(width);
}

/// Where the surround takes over from the level views, they have lost 13 dB; without it they show the main
/// lobe.
double vertical_edge_power(const FanGeometry& g) { return g.side_lobes ? 0.05 : 0.003; }

std::size_t bytes_of(const FanPlan& plan) {
    std::size_t bytes =
        sizeof(FanPlan) + plan.beams.size() * (sizeof(BeamLines) + sizeof(double)) +
        (plan.coverage.size() + plan.weight.size() + plan.line_weight.size()) * sizeof(float) +
        plan.surround.size() * sizeof(SurroundPixel) + plan.line_sector.size() * sizeof(SectorShare);
    for (const FanPart& part : plan.parts) bytes += part.far.size() * sizeof(float);
    return bytes;
}

}  // namespace

FanLobes::FanLobes(const FanGeometry& g)
    : horizontal(lobe_of(g, g.horizontal, g.beam_width, 0.003)),
      vertical(lobe_of(g, g.vertical, g.fan_height, vertical_edge_power(g))),
      surround(g.side_lobes),
      single(g.bearings.size() == 1 && g.patterns),
      piston(single && g.vertical.shape == ApertureShape::piston) {}

double FanLobes::of_piston(double bearing, double elevation) const {
    return vertical.power(std::acos(std::clamp(std::cos(bearing) * std::cos(elevation), -1.0, 1.0)));
}

const View& FanPlan::view_of(std::size_t line) const {
    const auto after =
        std::upper_bound(views.begin(), views.begin() + static_cast<std::ptrdiff_t>(level_views), line,
                         [](std::size_t l, const View& view) { return l < view.first_line; });
    return *(after - 1);
}

const View& FanPlan::view_at(double bearing) const {
    const auto off = [bearing](const View& view) {
        return std::abs(bearing - view.bearing) - std::atan(view.right);
    };
    return *std::min_element(views.begin(), views.begin() + static_cast<std::ptrdiff_t>(level_views),
                             [&](const View& a, const View& b) { return off(a) < off(b); });
}

const FanPart& FanPlan::part_of(const View& view) const {
    const auto number = static_cast<std::size_t>(&view - views.data());
    const auto after = std::find_if(parts.begin(), parts.end(), [&](const FanPart& part) {
        return number < part.first_surround + part.surrounds;
    });
    return after == parts.end() ? parts.back() : *after;
}

FanGeometry geometry_of(const Shot& shot, const Effects& effects) {
    const double end = shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval;
    const bool patterns = effects.has(Effect::beam_pattern);
    return {
        shot.bearings,   shot.beam_width, shot.fan_height, std::max(2 * shot.bin_interval / end, lowest_step),
        shot.horizontal, shot.vertical,   patterns,        patterns && effects.has(Effect::side_lobes),
        shot.elevations};
}

FanPlan plan_fan(const FanGeometry& geometry, const PlanDensity& density) {
    const FanLobes lobes(geometry);
    FanPlan plan;
    plan.geometry = geometry;
    plan.parts = split_beams(geometry);
    for (const double bearing : geometry.bearings) plan.beams.push_back({.bearing = bearing});
    for (FanPart& part : plan.parts) add_level_views(plan, part, geometry, density, lobes);
    plan.level_views = plan.views.size();
    plan.lines = plan.image_lines;
    weigh_level_pixels(plan, lobes, geometry.fan_height);
    plan.first_surround_pixel = plan.weight.size();
    for (FanPart& part : plan.parts) {
        share_lines(plan, part, geometry, lobes);
        if (geometry.side_lobes) add_surround(plan, part, geometry, lobes, density.pixels);
        if (geometry.side_lobes) add_far_lobes(plan, part, geometry, lobes);
    }
    plan.bytes = bytes_of(plan);
    return plan;
}

}  // namespace echoloop
