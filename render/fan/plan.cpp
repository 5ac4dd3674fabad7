#include "render/fan/plan.h"

#include <algorithm>
#include <cmath>

#include "render/fan/arrays.h"
#include "render/fan/plan_parts.h"

namespace echoloop {
namespace {

/// A sample moves a surface at 45 deg by `bins` at the window's end, but by no less than `least` rad, since
/// finer samples show nothing but finer outlines. A line of a fan is heard together with its neighbours by
/// every beam, which evens out what coarser samples scatter (render/README.md); a single beam has its own
/// only.
struct ElevationStep {
    double bins, least;
};
constexpr ElevationStep step_of_fan{2.7, deg_to_rad(0.27)}, step_of_single_beam{2, deg_to_rad(0.2)};

Lobe lobe_of(const FanGeometry& g, AxisPattern axis, double width, double edge_power) {
    return g.patterns ? Lobe::pattern(axis, width, edge_power) : Lobe::box(width);
}

/// Where the surround takes over from the level views, they have lost 13 dB; without it they show the main
/// lobe.
double vertical_edge_power(const FanGeometry& g) { return g.side_lobes ? 0.05 : 0.003; }

std::size_t bytes_of(const FanPlan& plan) {
    const std::size_t bytes =
        sizeof(FanPlan) + plan.beams.size() * (sizeof(BeamLines) + sizeof(double)) +
        (plan.coverage.size() + plan.weight.size() + plan.line_weight.size()) * sizeof(float) +
        plan.surround.size() * sizeof(SurroundPixel) + plan.line_sector.size() * sizeof(SectorShare);
    return bytes + plan.far_lobes.weight.size() * sizeof(float);
}

}  // namespace

FanLobes::FanLobes(const FanGeometry& g, std::shared_ptr<const StaveErrors> errors)
    : horizontal(lobe_of(g, g.horizontal, g.beam_width, 0.003)),
      vertical(lobe_of(g, g.vertical, g.fan_height, vertical_edge_power(g))),
      surround(g.side_lobes),
      single(g.bearings.size() == 1 && g.patterns),
      piston(single && g.vertical.shape == ApertureShape::piston) {
    if (errors) horizontal.set_errors(std::move(errors));
}

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

FanGeometry geometry_of(const Shot& shot, const Effects& effects) {
    const double end = shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval;
    const bool patterns = effects.has(Effect::beam_pattern);
    const bool side_lobes = patterns && effects.has(Effect::side_lobes);
    const ElevationStep step = shot.bearings.size() > 1 ? step_of_fan : step_of_single_beam;
    FanGeometry geometry{.bearings = shot.bearings,
                         .beam_width = shot.beam_width,
                         .fan_height = shot.fan_height,
                         .elevation_step = std::max(step.bins * shot.bin_interval / end, step.least),
                         .horizontal = shot.horizontal,
                         .vertical = shot.vertical,
                         .patterns = patterns,
                         .side_lobes = side_lobes,
                         .elevations = shot.elevations};
    const bool has_errors = shot.errors.amplitude > 0 || shot.errors.phase > 0;
    if (side_lobes && has_errors && effects.has(Effect::array_errors) && shot.bearings.size() > 1 &&
        shot.rows() == 1) {
        geometry.errors = shot.errors;
        geometry.errors.unit = unit_of(shot);
        geometry.staves = static_cast<std::size_t>(std::max(shot.receiver.staves, 0));
    }
    return geometry;
}

FanPlan plan_fan(const FanGeometry& geometry, const PlanDensity& density) {
    FanPlan plan;
    if (geometry.errors != ArrayErrors{})
        plan.errors = std::make_shared<const StaveErrors>(
            TwoWayPattern(geometry.horizontal, geometry.beam_width).aperture(), geometry.staves,
            geometry.errors);
    const FanLobes lobes(geometry, plan.errors);
    plan.geometry = geometry;
    plan.centre = (geometry.bearings.front() + geometry.bearings.back()) / 2;
    for (const double bearing : geometry.bearings) plan.beams.push_back({.bearing = bearing});
    add_level_views(plan, geometry, density, lobes);
    plan.level_views = plan.views.size();
    plan.lines = plan.image_lines;
    weigh_level_pixels(plan, lobes, geometry.fan_height);
    plan.first_surround_pixel = plan.weight.size();
    share_lines(plan, geometry, lobes);
    if (geometry.side_lobes) add_surround(plan, geometry, lobes, density.pixels);
    if (geometry.side_lobes) add_far_lobes(plan, geometry, lobes);
    plan.bytes = bytes_of(plan);
    return plan;
}

}  // namespace echoloop
