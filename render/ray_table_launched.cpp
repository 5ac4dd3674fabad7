// What a table says of rays by how they leave: how they spread, where they end, where they meet the surface.
#include <algorithm>
#include <cmath>

#include "render/ray_shooter.h"
#include "render/ray_table.h"
#include "render/refraction.h"

namespace echoloop {

/// Ray tubes between neighbours half a milliradian apart: what spreads over cos(e) at the sonar's distance of
/// 1 m spreads over the distance times the width of the tube.
void RayTable::find_focus(std::span<const SoundSpeedPoint> profile) {
    constexpr double apart = 5e-4;
    focus_.assign(static_cast<std::size_t>(focus_rows * focus_columns), 1.0F);
    ends_.assign(focus_.size(), {});
    focus_per_metre_ = static_cast<float>((focus_columns - 1) / range_);
    const double step = range_ / (focus_columns - 1) / speed_;  // s
    for (int row = 0; row < focus_rows; ++row) {
        const double up = 2.0 * row / (focus_rows - 1) - 1;
        const double elevation = std::clamp(std::asin(up), -1.57, 1.57);
        RayPoint lower{0, depth_, elevation - apart / 2}, upper{0, depth_, elevation + apart / 2};
        for (int column = 1; column < focus_columns; ++column) {
            lower = ray_after(profile, lower, step), upper = ray_after(profile, upper, step);
            const double length = step * speed_ * column, x = (lower.distance + upper.distance) / 2;
            const double width =
                std::hypot(upper.distance - lower.distance, upper.depth - lower.depth) / apart;
            const double spread = x * width / std::cos(elevation);
            const auto focus = static_cast<float>(std::clamp(length * length / spread, 0.1, 10.0));
            const auto at = static_cast<std::size_t>(row * focus_columns + column);
            const double along = x / (length * std::cos(elevation)),
                         height = depth_ - (lower.depth + upper.depth) / 2;
            ends_[at] = {static_cast<float>(along), static_cast<float>(height / length - along * up)};
            focus_[at] = focus;
            focuses_ |= std::abs(focus - 1) > 0.02F;
        }
    }
}

void RayTable::find_surface(std::span<const SoundSpeedPoint> profile) {
    std::vector<rays::Level> levels{{0, sound_speed_at(profile, 0), 0}};
    for (const SoundSpeedPoint& point : profile)
        if (point.depth != 0) levels.push_back({point.depth, point.speed, -1});
    std::ranges::stable_sort(levels, {}, &rays::Level::depth);
    const rays::Shooter shooter(levels, depth_, speed_, column_step_ * static_cast<double>(columns));
    std::vector<rays::RowCrossings> out(1);
    auto& [inverse, sine, slope, straight] = surfacing_;
    inverse.assign(Surfacing::places, 0), sine.assign(Surfacing::places, 0);
    slope.assign(Surfacing::places, 1);
    for (std::size_t i = 0; i < Surfacing::places; ++i) {
        const double root = static_cast<double>(i) / Surfacing::half - 1;
        const double elevation = std::asin(std::clamp(root * std::abs(root), -1 + 1e-9, 1 - 1e-9));
        shooter.shoot(elevation, out);
        for (std::size_t kind = 0; kind < rays::kinds; ++kind) {
            if (!out[0].has(kind)) continue;
            const rays::Crossing& first = out[0].all[kind];
            inverse[i] = static_cast<float>(1 / (std::hypot(first.distance, depth_) * (1 + first.stretch)));
            sine[i] = static_cast<float>(std::sin(elevation + first.bow));
            break;
        }
        const double unbent = std::max(0.0, std::sin(elevation)) / depth_;
        straight &= std::abs(static_cast<double>(inverse[i]) - unbent) <= 2e-4 * std::max(unbent, 1 / range_);
    }
    for (std::size_t i = 1; i + 1 < Surfacing::places; ++i) {
        const float place = static_cast<float>(i) - Surfacing::half;
        if (inverse[i - 1] > 0 && inverse[i + 1] > 0)
            slope[i] = (std::log(inverse[i + 1]) - std::log(inverse[i - 1])) * place / 4;
    }
}

}  // namespace echoloop
