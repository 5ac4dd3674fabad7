#include <algorithm>
#include <cmath>

#include "render/fan/plan_parts.h"

namespace echoloop {
namespace {

constexpr double widest_view =
    deg_to_rad(62);  ///< beyond, the edge's pixels would be much narrower than the centre's
constexpr double widest_line = deg_to_rad(0.4);
/// Times the usual pixels, beyond which echoes are spread over what there is and outlines are sharp: who asks
/// for so many wants to see more.
constexpr double many_pixels = 4;
constexpr std::size_t fewest_lines = 8, most_lines = 8192;
constexpr std::size_t fewest_samples = 64, most_samples = 2048, most_pixels = std::size_t{4} << 20;

std::size_t count(double wished, std::size_t fewest, std::size_t most) {
    return static_cast<std::size_t>(
        std::clamp(std::ceil(wished), static_cast<double>(fewest), static_cast<double>(most)));
}

View level_view(double bearing, double width, double half_height) {
    View view;
    view.bearing = bearing;
    view.right = std::tan(width / 2);
    view.left = -view.right;
    view.top = std::tan(half_height) / std::cos(width / 2);  // the corner's elevation is inside
    view.bottom = -view.top;
    return view;
}

/// Appends one line's weights: the vertical pattern, or the whole one of a piston.
void weigh_line(FanPlan& plan, const View& view, std::size_t line, const FanLobes& lobes) {
    const double at = static_cast<double>(line) + 0.5, x2 = view.x(at) * view.x(at);
    const double edge = drawn_half_height(lobes), bearing = view.bearing_at(at) - plan.beams.front().bearing;
    double upper = view.elevation_at(at, 0);
    for (std::size_t sample = 0; sample < view.samples; ++sample) {
        const double lower = view.elevation_at(at, static_cast<double>(sample + 1));
        const double covered = share_within(lower, upper, -edge, edge);
        const double from = std::max(lower, -edge), to = std::min(upper, edge);
        double power =
            covered > 0 && from < to && !lobes.vertical.is_box() ? lobes.vertical.mean(from, to) : 1.0;
        if (lobes.piston && covered > 0) power = lobes.of_piston(bearing, (from + to) / 2);
        if (lobes.surround) power *= level_share(lobes, (from + to) / 2);
        upper = lower;
        plan.coverage.push_back(static_cast<float>(covered));
        plan.weight.push_back(static_cast<float>(covered * power * view.solid_angle(x2, sample)));
    }
}

SampleRange nominal_samples(const View& view, std::size_t line, double fan_height) {
    const double at = static_cast<double>(line) + 0.5;
    SampleRange range{view.samples, 0};
    for (std::size_t sample = 0; sample < view.samples; ++sample)
        if (view.elevation_at(at, static_cast<double>(sample)) > -fan_height / 2 &&
            view.elevation_at(at, static_cast<double>(sample + 1)) < fan_height / 2)
            range = {std::min(range.first, sample), sample + 1};
    return range;
}

/// Over the sine of the angle off the axis, up to an angle. Without side lobes, the main lobe only.
LobeTable sine_table(const Lobe& lobe, bool side_lobes, double reach, double step) {
    LobeTable table{step, {}};
    for (double sine = 0; sine < std::sin(reach) + 3 * step; sine += step) {
        const double angle = std::asin(std::min(sine, 1.0));
        table.values.push_back(side_lobes || angle <= lobe.edge() ? static_cast<float>(lobe.power(angle))
                                                                  : 0.0F);
    }
    return table;
}

/// rad beside the axis, within which the main lobe lies at all elevations that are drawn finely: an upright
/// aperture's is wider in bearing the higher it looks.
double drawn_half_width(const FanLobes& lobes) {
    const double edge = lobes.horizontal.edge();
    if (!lobes.single || lobes.piston) return edge;
    return std::asin(std::min(1.0, std::sin(edge) / std::cos(drawn_half_height(lobes))));
}

SidedLobeTable lobe_table(const Lobe& lobe, double reach, double step) {
    SidedLobeTable table{{step, {}}, {step, {}}};
    for (double off = 0; off < reach + 2 * step; off += step) {
        table.left.values.push_back(static_cast<float>(lobe.power(-off)));
        table.right.values.push_back(static_cast<float>(lobe.power(off)));
    }
    return table;
}

/// Views whose pixels weigh the same, as beams share out the lines. A piston's pattern is in its pixels'
/// weights.
bool alike(const View& a, const View& b, const FanLobes& lobes) {
    return a.right == b.right && a.lines == b.lines && !lobes.piston;
}

/// What a beam hears between two angles off its axis, relative to the axis: Simpson's rule.
double mean_of(const SidedLobeTable& lobe, double low, double high) {
    const auto at = [&](double angle) { return static_cast<double>(lobe.at(static_cast<float>(angle))); };
    return (at(low) + 4 * at((low + high) / 2) + at(high)) / 6;
}

/// Number of lines wholly or partly left of `bearing`.
std::size_t lines_before(const FanPlan& plan, double bearing) {
    std::size_t lines = 0;
    for (std::size_t v = 0; v < plan.level_views; ++v) {
        const View& view = plan.views[v];
        const double off = std::clamp(bearing - view.bearing, -widest_view, widest_view);
        const double line = std::ceil((std::tan(off) - view.left) / view.line_width() - 1e-9);
        lines += static_cast<std::size_t>(std::clamp(line, 0.0, static_cast<double>(view.lines)));
    }
    return lines;
}

}  // namespace

std::vector<LineBearings> bearings_of_lines(const FanPlan& plan) {
    std::vector<LineBearings> bearings;
    for (std::size_t v = 0; v < plan.level_views; ++v)
        for (std::size_t line = 0; line < plan.views[v].lines; ++line) {
            const auto at = static_cast<double>(line);
            const View& view = plan.views[v];
            bearings.push_back({view.bearing_at(at), view.bearing_at(at + 0.5), view.bearing_at(at + 1)});
        }
    return bearings;
}

void add_level_views(FanPlan& plan, const FanGeometry& g, const PlanDensity& density, const FanLobes& lobes) {
    const double edge = drawn_half_width(lobes) + g.margin;
    plan.first_edge = std::max(g.bearings.front() - edge, plan.centre - std::numbers::pi);
    plan.last_edge = std::min(g.bearings.back() + edge, plan.centre + std::numbers::pi);
    const double span = plan.last_edge - plan.first_edge;
    const auto views = static_cast<std::size_t>(std::ceil(span / widest_view));
    const double width = span / static_cast<double>(views);
    const double line = std::min(g.beam_width / density.columns_per_beam, widest_line);
    const bool many = density.pixels > many_pixels;
    const double pixels = many ? density.pixels : std::min(density.pixels, 1.0);  // before they are cut
    const double per_side = std::sqrt(pixels), parts = density.pixels / pixels;
    for (std::size_t i = 0; i < views; ++i) {
        const double bearing = plan.first_edge + (static_cast<double>(i) + 0.5) * width;
        View view = level_view(bearing, width, drawn_half_height(lobes));
        const double lines = (view.right - view.left) / line * per_side;
        const std::size_t whole_lines = count(lines, fewest_lines, most_lines / views);
        const std::size_t whole =
            count((view.top - view.bottom) / g.elevation_step * per_side, fewest_samples,
                  std::min(most_samples, most_pixels / (views * whole_lines)));
        const std::size_t cuts = std::clamp<std::size_t>(most_samples / whole, 1, cuts_per_side(parts));
        view.lines = count(lines * parts / static_cast<double>(cuts), fewest_lines, most_lines / views);
        view.samples = whole * cuts;
        view.usual_width = usual_size(view.lines, whole_lines);
        view.sharp_outlines = g.bearings.size() == 1 || many;
        view.first_line = plan.image_lines;
        plan.image_lines += view.lines;
        plan.usual_samples = std::max(plan.usual_samples, whole);
        plan.samples = std::max(plan.samples, view.samples);
        plan.views.push_back(view);
    }
}

void weigh_level_pixels(FanPlan& plan, const FanLobes& lobes, double fan_height) {
    for (std::size_t v = 0; v < plan.level_views; ++v) {
        View& view = plan.views[v];
        view.samples = plan.samples;
        view.usual_height = usual_size(plan.samples, plan.usual_samples);
        for (std::size_t line = 0; line < view.lines; ++line)
            plan.nominal.push_back(nominal_samples(view, line, fan_height));
        if (v > 0 && alike(view, plan.views[v - 1], lobes)) {
            view.first_pixel = plan.views[v - 1].first_pixel;
            continue;
        }
        view.first_pixel = plan.weight.size();
        for (std::size_t line = 0; line < view.lines; ++line) weigh_line(plan, view, line, lobes);
    }
}

void share_lines(FanPlan& plan, const FanGeometry& g, const FanLobes& lobes) {
    const double reach = lobes.single                                 ? plan.last_edge - g.bearings.front()
                         : lobes.horizontal.is_box() || !g.side_lobes ? lobes.horizontal.edge()
                                                                      : near_beam_widths * g.beam_width;
    if (!lobes.horizontal.is_box() && !lobes.single)
        plan.across = lobe_table(lobes.horizontal, reach + 2 * widest_line, g.beam_width / 100);
    if (lobes.single && !lobes.piston)
        plan.beside =
            sine_table(lobes.horizontal, g.side_lobes, reach + widest_line, std::sin(g.beam_width) / 100);
    const auto bearings = bearings_of_lines(plan);
    for (BeamLines& beam : plan.beams) {
        const double bearing = beam.bearing;
        const auto begin = [&](double edge) { return lines_before(plan, bearing + edge); };
        const auto widened = [&](double edge) { return std::max<std::size_t>(begin(edge), 1) - 1; };
        beam.first_line = widened(-reach);
        beam.lines = begin(reach) - beam.first_line;
        beam.first_nominal = widened(-g.beam_width / 2);
        beam.nominal_lines = begin(g.beam_width / 2) - beam.first_nominal;
        beam.first_weight = plan.line_weight.size();
        for (std::size_t line = beam.first_line; line < beam.first_line + beam.lines; ++line) {
            const double low = bearings[line].low - bearing, high = bearings[line].high - bearing;
            const double mean = lobes.single          ? 1.0
                                : plan.across.empty() ? lobes.horizontal.mean(low, high)
                                                      : mean_of(plan.across, low, high);
            plan.line_weight.push_back(static_cast<float>(mean));
        }
    }
}

}  // namespace echoloop
