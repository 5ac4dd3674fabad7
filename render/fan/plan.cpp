#include "render/fan/plan.h"

#include <algorithm>
#include <cmath>

namespace echoloop {
namespace {

constexpr double widest_view =
    deg_to_rad(62);  ///< beyond, the edge's pixels would be much narrower than the centre's
constexpr double widest_line = deg_to_rad(0.2);
constexpr std::size_t fewest_lines = 16, most_lines = 8192;
constexpr std::size_t fewest_samples = 64, most_samples = 2048, most_pixels = std::size_t{4} << 20;

std::size_t count(double wished, std::size_t fewest, std::size_t most) {
    return static_cast<std::size_t>(
        std::clamp(std::ceil(wished), static_cast<double>(fewest), static_cast<double>(most)));
}

std::vector<View> split_bearings(const FanGeometry& g) {
    const double first = g.bearings.front() - g.beam_width / 2, last = g.bearings.back() + g.beam_width / 2;
    const auto number = static_cast<std::size_t>(std::ceil((last - first) / widest_view));
    const double width = (last - first) / static_cast<double>(number);
    std::vector<View> views(number);
    for (std::size_t i = 0; i < number; ++i) {
        View& view = views[i];
        view.bearing = first + (static_cast<double>(i) + 0.5) * width;
        view.right = std::tan(width / 2);
        view.left = -view.right;
        view.top = std::tan(g.fan_height / 2) / std::cos(width / 2);  // the corner's elevation is inside
        view.bottom = -view.top;
    }
    return views;
}

void choose_pixels(FanPlan& plan, const FanGeometry& g, const PlanDensity& density) {
    const double per_side = std::sqrt(density.pixels);
    const View& view = plan.views.front();  // all are alike
    const double line = std::min(g.beam_width / density.columns_per_beam, widest_line) / per_side;
    const std::size_t lines =
        count((view.right - view.left) / line, fewest_lines, most_lines / plan.views.size());
    plan.lines = lines * plan.views.size();
    plan.samples = count((view.top - view.bottom) / g.elevation_step * per_side, fewest_samples,
                         std::min(most_samples, most_pixels / plan.lines));
    for (std::size_t i = 0; i < plan.views.size(); ++i) {
        plan.views[i].lines = lines;
        plan.views[i].samples = plan.samples;
        plan.views[i].first_line = i * lines;
    }
}

/// The share of the interval low..high that lies within first..last.
double share(double low, double high, double first, double last) {
    return std::max(0.0, std::min(high, last) - std::max(low, first)) / (high - low);
}

/// Appends one line's weights.
void weigh_line(FanPlan& plan, const View& view, std::size_t line, double fan_height) {
    const double at = static_cast<double>(line) + 0.5, x2 = view.x(at) * view.x(at);
    double upper = view.elevation_at(at, 0);
    for (std::size_t sample = 0; sample < view.samples; ++sample) {
        const double lower = view.elevation_at(at, static_cast<double>(sample + 1));
        const double covered = share(lower, upper, -fan_height / 2, fan_height / 2);
        upper = lower;
        plan.coverage.push_back(static_cast<float>(covered));
        plan.solid_angle.push_back(static_cast<float>(covered * view.solid_angle(x2, sample)));
    }
}

/// All views are alike, so the first one's weights serve for all.
void weigh_pixels(FanPlan& plan, double fan_height) {
    plan.coverage.reserve(plan.lines * plan.samples);
    plan.solid_angle.reserve(plan.lines * plan.samples);
    const View& view = plan.views.front();
    for (std::size_t line = 0; line < view.lines; ++line) weigh_line(plan, view, line, fan_height);
    for (std::vector<float>* weights : {&plan.coverage, &plan.solid_angle}) {
        const std::vector<float> one = *weights;
        for (std::size_t i = 1; i < plan.views.size(); ++i)
            weights->insert(weights->end(), one.begin(), one.end());
    }
}

void share_lines(FanPlan& plan, const FanGeometry& g) {
    plan.first_share.push_back(0);
    std::size_t first_beam = 0;  // beams before it end before the line
    for (const View& view : plan.views)
        for (std::size_t line = 0; line < view.lines; ++line) {
            const double low = view.bearing_at(static_cast<double>(line));
            const double high = view.bearing_at(static_cast<double>(line + 1));
            while (first_beam < g.bearings.size() && g.bearings[first_beam] + g.beam_width / 2 <= low)
                ++first_beam;
            for (std::size_t beam = first_beam; beam < g.bearings.size(); ++beam) {
                const double left = g.bearings[beam] - g.beam_width / 2;
                if (left >= high) break;
                const double weight = share(low, high, left, left + g.beam_width);
                plan.shares.push_back({static_cast<std::uint32_t>(beam), static_cast<float>(weight)});
            }
            plan.first_share.push_back(static_cast<std::uint32_t>(plan.shares.size()));
        }
}

}  // namespace

const View& FanPlan::view_of(std::size_t line) const { return views[line / views.front().lines]; }

FanGeometry geometry_of(const Shot& shot) {
    const double end = shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval;
    return {shot.bearings, shot.beam_width, shot.fan_height, shot.bin_interval / end};
}

FanPlan plan_fan(const FanGeometry& geometry, const PlanDensity& density) {
    FanPlan plan;
    plan.views = split_bearings(geometry);
    choose_pixels(plan, geometry, density);
    weigh_pixels(plan, geometry.fan_height);
    share_lines(plan, geometry);
    return plan;
}

}  // namespace echoloop
