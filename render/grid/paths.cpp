#include "render/grid/paths.h"

#include <algorithm>
#include <cmath>

#include "render/fan/far_lobes.h"

namespace echoloop {
namespace {

class Sharing {
  public:
    explicit Sharing(const GridPlan& plan)
        : plan_(plan),
          rows_(plan.geometry.elevations),
          side_lobes_(plan.geometry.side_lobes),
          lobes_(plan.lobes) {}

    /// Main lobes over the directions that it comes from.
    void add(const PathEcho& echo, std::vector<Arrival>& arrivals) const {
        const double half_height = std::max(1e-6F, echo.height / 2),
                     reach = lobes_.upwards.edge() + half_height;
        const double across = cone_angle(echo.bearing, echo.elevation);
        const double half_width = std::max(1e-6, echo.width / 2 * std::cos(double{echo.elevation}));
        const auto first = std::ranges::lower_bound(rows_, echo.elevation - reach);
        for (auto row = first; row != rows_.end() && *row < echo.elevation + reach; ++row) {
            const auto number = static_cast<std::size_t>(row - rows_.begin());
            const double off = echo.elevation - *row;
            const double up = lobes_.upwards.mean(off - half_height, off + half_height);
            for_columns(
                number, across, lobes_.across.edge() + half_width, [&](std::size_t beam, double beside) {
                    const double share = up * lobes_.across.mean(beside - half_width, beside + half_width);
                    const auto power = static_cast<float>(echo.power * share);
                    if (power > 0) arrivals.push_back({beam, echo.near_range, echo.far_range, power});
                });
        }
    }

    /// Main lobes, and side lobes along the row and the column.
    void add(const TargetEcho& echo, std::vector<PointEcho>& points) const {
        constexpr double least = 1e-8;  // of the axis: not heard
        const double across = cone_angle(echo.bearing, echo.elevation), everywhere = 4;
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            const double off = echo.elevation - rows_[row];
            const bool in_row = std::abs(off) < lobes_.upwards.edge();
            if (!in_row && !side_lobes_) continue;
            const double up = lobes_.vertical.power(off);
            const double reach = in_row && side_lobes_ ? everywhere : lobes_.across.edge();
            for_columns(row, across, reach, [&](std::size_t beam, double beside) {
                const double share = up * lobes_.horizontal.power(beside);
                if (share > least) points.push_back({beam, echo.range, echo.power * share, echo.phase});
            });
        }
    }

  private:
    /// Calls use(beam, angle off its axis) for a row's beams within `reach`.
    template <typename Use>
    void for_columns(std::size_t row, double across, double reach, const Use& use) const {
        const auto axes = std::span(plan_.axes).subspan(row * plan_.columns, plan_.columns);
        for (auto axis = std::ranges::lower_bound(axes, across - reach);
             axis != axes.end() && *axis < across + reach; ++axis)
            use(row * plan_.columns + static_cast<std::size_t>(axis - axes.begin()), across - *axis);
    }

    const GridPlan& plan_;
    const std::vector<double>& rows_;
    bool side_lobes_;
    const GridLobes& lobes_;
};

}  // namespace

std::vector<Arrival> arrivals_of(const GridPlan& plan, std::span<const PathEcho> echoes) {
    const Sharing sharing(plan);
    std::vector<Arrival> arrivals;
    for (const PathEcho& echo : echoes) sharing.add(echo, arrivals);
    return arrivals;
}

std::vector<PointEcho> points_of(const GridPlan& plan, std::span<const TargetEcho> echoes) {
    const Sharing sharing(plan);
    std::vector<PointEcho> points;
    for (const TargetEcho& echo : echoes) sharing.add(echo, points);
    return points;
}

}  // namespace echoloop
