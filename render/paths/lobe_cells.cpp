#include "render/paths/lobe_cells.h"

#include <algorithm>

namespace echoloop {
namespace {

constexpr std::size_t most_columns = 32, fan_cells = 512, most_rows = 32;
constexpr std::size_t columns_of_rows = 64;  ///< where a shot has rows of beams

/// k-th value of the sequence in 0..1: the fraction of k / g or k / g^2, g = 1.32471795724.
double r2(std::uint64_t k, int axis) {
    constexpr std::uint64_t step[2] = {0xC13FA9A902A6328F, 0x91E10DA5C79E7B1D};
    return static_cast<double>((k * step[axis]) >> 11) * 0x1p-53;
}

}  // namespace

LobeCells::DenseByPower::DenseByPower(const TwoWayPattern& across, double half_width)
    : step_(half_width / static_cast<double>(parts)) {
    for (std::size_t i = 0; i < parts; ++i) {
        const double amplitude = across.amplitude((static_cast<double>(i) + 0.5) * step_);
        power_[i] = std::max(amplitude * amplitude, 1e-6);
        until_[i + 1] = until_[i] + power_[i];
    }
}

LobeCells::DenseByPower::Place LobeCells::DenseByPower::at(double share) const {
    const double sum = share * until_[parts];
    const auto after = std::upper_bound(until_.begin() + 1, until_.end() - 1, sum);
    const auto i = static_cast<std::size_t>(after - until_.begin()) - 1;
    return {(static_cast<double>(i) + (sum - until_[i]) / power_[i]) * step_,
            until_[parts] * step_ / power_[i]};
}

LobeCells::LobeCells(const Shot& shot, double half_width, double half_height, const TwoWayPattern* across)
    : half_height_(std::min(half_height, 1.5)), axis_(shot.bearings.front()) {
    if (shot.rows() > 1)
        half_height_ =
            std::min(1.5, half_height + std::max(-shot.elevations.front(), shot.elevations.back()));
    const std::size_t columns_at_most = shot.rows() > 1 ? columns_of_rows : most_columns;
    all_cells_ = shot.rows() > 1 ? columns_of_rows * most_rows : fan_cells;
    for (const double bearing : shot.bearings) {
        if (!intervals_.empty() && bearing - half_width <= intervals_.back().last)
            intervals_.back().last = bearing + half_width;
        else
            intervals_.push_back({bearing - half_width, bearing + half_width});
    }
    double total = 0;
    for (const Interval& interval : intervals_) total += interval.last - interval.first;
    const std::size_t wished = std::clamp(shot.bearings.size(), std::size_t{2}, columns_at_most);
    const std::size_t rows = std::min(most_rows, all_cells_ / wished);
    if (across != nullptr && shot.beams() == 1) dense_.emplace(*across, half_width);
    const auto edge = [&](std::size_t row) {
        return KnownAngle(half_height_ * (2.0 * static_cast<double>(row) / static_cast<double>(rows) - 1));
    };
    for (const Interval& interval : intervals_) {
        const double length = interval.last - interval.first;
        const double columns = std::ceil(length / total * static_cast<double>(wished) - 1e-9);
        for (double column = 0; column < columns; ++column)
            for (std::size_t row = 0; row < rows; ++row) {
                LobeCell cell;
                cell.first_bearing = interval.first + length * column / columns;
                cell.last_bearing = interval.first + length * (column + 1) / columns;
                cell.low = edge(row), cell.high = edge(row + 1);
                cells_.push_back(cell);
            }
    }
}

void LobeCells::place(std::uint64_t ping) {
    std::uint64_t k = ping * all_cells_;
    for (LobeCell& cell : cells_) {
        double bearing = std::lerp(cell.first_bearing, cell.last_bearing, r2(k, 0));
        double width = cell.last_bearing - cell.first_bearing;
        if (dense_) {  // one of two columns, either side of the axis
            const auto place = dense_->at(r2(k, 0));
            bearing = axis_ + (cell.first_bearing < cells_.back().first_bearing ? -place.off : place.off);
            width = place.width;
        }
        cell.bearing = KnownAngle(bearing);
        cell.elevation = KnownAngle(std::lerp(cell.low.at, cell.high.at, r2(k, 1)));
        // Of this ray: the mean over pings is the integral over the cell.
        cell.solid_angle = width * (cell.high.at - cell.low.at) * cell.elevation.cosine;
        ++k;
    }
}

bool LobeCells::contains(Vec3 direction) const {
    if (std::abs(direction.z) > std::sin(half_height_)) return false;
    const double bearing = std::atan2(-direction.y, direction.x);
    return std::ranges::any_of(
        intervals_, [bearing](const Interval& i) { return bearing >= i.first && bearing <= i.last; });
}

}  // namespace echoloop
