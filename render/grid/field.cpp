#include "render/grid/field.h"

#include <algorithm>
#include <cmath>

#include "render/fan/far_lobes.h"

namespace echoloop {
namespace {

constexpr double widest_view = deg_to_rad(50);
constexpr double samples_per_beam = 3;     ///< in a beam's height
constexpr double least_share = 3e-4;       ///< of a pixel's power; less is no echo of it
constexpr double fewest = 8, most = 2048;  ///< lines and samples of a view

std::size_t count(double wished) {
    return static_cast<std::size_t>(std::clamp(std::ceil(wished), fewest, most));
}

View field_view(const FieldLimits& limits, double bearing, double width) {
    View view;
    view.bearing = bearing;
    view.right = std::tan(width / 2);
    view.left = -view.right;
    // The limits' elevations are inside from the middle line to the outermost.
    const double corner = std::cos(width / 2);
    view.top = std::tan(limits.top) / (limits.top > 0 ? corner : 1);
    view.bottom = std::tan(limits.bottom) / (limits.bottom < 0 ? corner : 1);
    return view;
}

/// A pixel's directions: elevations, and cone angles as a row tells them apart.
struct Extent {
    double low, high, port, starboard;
};

class Hearers {
  public:
    explicit Hearers(GridPlan& plan) : plan_(plan) {}

    /// Appends who hears a pixel, beam by beam.
    void add(const Extent& pixel) {
        const double reach = plan_.lobes.upwards.edge();
        const auto& rows = plan_.geometry.elevations;
        const auto first = std::ranges::lower_bound(rows, pixel.low - reach);
        for (auto row = first; row != rows.end() && *row < pixel.high + reach; ++row)
            add_row(static_cast<std::size_t>(row - rows.begin()), pixel,
                    plan_.lobes.upwards.mean(pixel.low - *row, pixel.high - *row));
    }

  private:
    void add_row(std::size_t row, const Extent& pixel, double vertical) {
        const double reach = plan_.lobes.across.edge();
        const auto axes = std::span(plan_.axes).subspan(row * plan_.columns, plan_.columns);
        const auto first = std::ranges::lower_bound(axes, pixel.port - reach);
        for (auto axis = first; axis != axes.end() && *axis < pixel.starboard + reach; ++axis) {
            const double share =
                vertical * plan_.lobes.across.mean(pixel.port - *axis, pixel.starboard - *axis);
            if (share < least_share) continue;
            const std::size_t beam = row * plan_.columns + static_cast<std::size_t>(axis - axes.begin());
            plan_.heard.push_back({static_cast<std::uint16_t>(beam),
                                   static_cast<std::uint16_t>(std::lround(share * double{whole_share}))});
        }
    }

    GridPlan& plan_;
};

void weigh_line(GridPlan& plan, const View& view, std::size_t line, Hearers& hearers) {
    const auto at = static_cast<double>(line);
    const double x2 = view.x(at + 0.5) * view.x(at + 0.5);
    for (std::size_t sample = 0; sample < view.samples; ++sample) {
        const double high = view.elevation_at(at + 0.5, static_cast<double>(sample));
        const double low = view.elevation_at(at + 0.5, static_cast<double>(sample + 1));
        plan.coverage.push_back(1);
        plan.weight.push_back(static_cast<float>(view.solid_angle(x2, sample)));
        plan.first_heard.push_back(static_cast<std::uint32_t>(plan.heard.size()));
        hearers.add({low, high, cone_angle(view.bearing_at(at), (low + high) / 2),
                     cone_angle(view.bearing_at(at + 1), (low + high) / 2)});
    }
}

}  // namespace

FieldLimits limits_of(const GridPlan& plan) {
    const FanGeometry& g = plan.geometry;
    const GridLobes& lobes = plan.lobes;
    const auto& [low, high] = std::pair(g.elevations.front(), g.elevations.back());
    const double tallest = std::max(std::abs(low), std::abs(high)), above = lobes.upwards.edge();
    // A cone angle changes more slowly than the bearing where it is far off both axes.
    const double beside = 1.5 * lobes.across.edge() / std::cos(std::min(tallest + above, deg_to_rad(70)));
    return {g.bearings.front() - beside, g.bearings.back() + beside, low - above, high + above};
}

void add_field(GridPlan& plan, const FieldLimits& limits, const PlanDensity& density) {
    const FanGeometry& g = plan.geometry;
    const double span = limits.right - limits.left, per_side = std::sqrt(density.pixels);
    const double views = std::ceil(span / widest_view), width = span / views;
    for (double i = 0; i < views; ++i) {
        View view = field_view(limits, limits.left + (i + 0.5) * width, width);
        view.lines = count((view.right - view.left) / g.beam_width * density.columns_per_beam * per_side);
        view.samples = count((view.top - view.bottom) / g.fan_height * samples_per_beam * per_side);
        view.first_line = plan.image_lines;
        plan.image_lines += view.lines;
        plan.samples = std::max(plan.samples, view.samples);
        plan.views.push_back(view);
    }
    plan.level_views = plan.views.size();
    Hearers hearers(plan);
    for (View& view : plan.views) {
        view.first_pixel = plan.weight.size();
        for (std::size_t line = 0; line < view.lines; ++line) weigh_line(plan, view, line, hearers);
    }
    plan.first_heard.push_back(static_cast<std::uint32_t>(plan.heard.size()));
}

}  // namespace echoloop
