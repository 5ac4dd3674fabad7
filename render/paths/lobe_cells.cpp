#include "render/paths/lobe_cells.h"

#include <algorithm>
#include <array>
#include <optional>

namespace echoloop {
namespace {

constexpr std::size_t most_columns = 32, fan_cells = 512, most_rows = 32;
constexpr std::size_t columns_of_rows = 64;  ///< where a shot has rows of beams

/// k-th value of the sequence in 0..1: the fraction of k / g or k / g^2, g = 1.32471795724.
double r2(std::uint64_t k, int axis) {
    constexpr std::uint64_t step[2] = {0xC13FA9A902A6328F, 0x91E10DA5C79E7B1D};
    return static_cast<double>((k * step[axis]) >> 11) * 0x1p-53;
}

/// Places on one side of a beam's axis, as dense as its power one way.
class DenseByPower {
  public:
    DenseByPower(const TwoWayPattern& across, double half_width)
        : step_(half_width / static_cast<double>(parts)) {
        for (std::size_t i = 0; i < parts; ++i) {
            const double amplitude = across.amplitude((static_cast<double>(i) + 0.5) * step_);
            power_[i] = std::max(amplitude * amplitude, 1e-6);
            until_[i + 1] = until_[i] + power_[i];
        }
    }
    struct Place {
        double off, width;  ///< rad from the axis; rad that a ray there stands for
    };
    Place at(double share) const {
        const double sum = share * until_[parts];
        const auto after = std::upper_bound(until_.begin() + 1, until_.end() - 1, sum);
        const auto i = static_cast<std::size_t>(after - until_.begin()) - 1;
        return {(static_cast<double>(i) + (sum - until_[i]) / power_[i]) * step_,
                until_[parts] * step_ / power_[i]};
    }

  private:
    static constexpr std::size_t parts = 32;
    double step_;
    std::array<double, parts> power_{};
    std::array<double, parts + 1> until_{};
};

}  // namespace

LobeCells::LobeCells(const Shot& shot, double half_width, double half_height, const TwoWayPattern* across)
    : half_height_(std::min(half_height, 1.5)) {
    if (shot.rows() > 1)
        half_height_ =
            std::min(1.5, half_height + std::max(-shot.elevations.front(), shot.elevations.back()));
    const std::size_t columns_at_most = shot.rows() > 1 ? columns_of_rows : most_columns;
    const std::size_t all_cells = shot.rows() > 1 ? columns_of_rows * most_rows : fan_cells;
    for (const double bearing : shot.bearings) {
        if (!intervals_.empty() && bearing - half_width <= intervals_.back().last)
            intervals_.back().last = bearing + half_width;
        else
            intervals_.push_back({bearing - half_width, bearing + half_width});
    }
    double total = 0;
    for (const Interval& interval : intervals_) total += interval.last - interval.first;
    const std::size_t wished = std::clamp(shot.bearings.size(), std::size_t{2}, columns_at_most);
    const std::size_t rows = std::min(most_rows, all_cells / wished);
    std::optional<DenseByPower> dense;
    if (across != nullptr && shot.beams() == 1) dense.emplace(*across, half_width);
    std::uint64_t k = shot.ping * all_cells;
    for (const Interval& interval : intervals_) {
        const double length = interval.last - interval.first;
        const double columns = std::ceil(length / total * static_cast<double>(wished) - 1e-9);
        for (double column = 0; column < columns; ++column)
            for (std::size_t row = 0; row < rows; ++row, ++k) {
                LobeCell cell;
                cell.first_bearing = interval.first + length * column / columns;
                cell.last_bearing = interval.first + length * (column + 1) / columns;
                cell.low = half_height_ * (2.0 * static_cast<double>(row) / static_cast<double>(rows) - 1);
                cell.high =
                    half_height_ * (2.0 * static_cast<double>(row + 1) / static_cast<double>(rows) - 1);
                cell.bearing = std::lerp(cell.first_bearing, cell.last_bearing, r2(k, 0));
                double width = cell.last_bearing - cell.first_bearing;
                if (dense) {  // one of two columns, either side of the axis
                    const auto place = dense->at(r2(k, 0));
                    cell.bearing = shot.bearings.front() + (column == 0 ? -place.off : place.off);
                    width = place.width;
                }
                cell.elevation = std::lerp(cell.low, cell.high, r2(k, 1));
                // Of this ray: the mean over pings is the integral over the cell.
                cell.solid_angle = width * (cell.high - cell.low) * std::cos(cell.elevation);
                cells_.push_back(cell);
            }
    }
}

bool LobeCells::contains(double bearing, double elevation) const {
    if (std::abs(elevation) > half_height_) return false;
    return std::ranges::any_of(
        intervals_, [bearing](const Interval& i) { return bearing >= i.first && bearing <= i.last; });
}

}  // namespace echoloop
