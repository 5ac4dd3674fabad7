// Side lobes far off the axis. Their echo is summed into sectors of the angle about the array's plane, and
// each sector reaches a beam with its mean two-way pattern: the lobes themselves are far narrower than what
// is seen through them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/acoustics/pattern.h"
#include "render/fan/plan.h"

namespace echoloop {

inline constexpr std::size_t sectors_per_array = 60;  ///< over 180 deg

/// Sectors of an array with several beams: of its level lines, of what lies beside them, and of what lies
/// above and below. A single beam has one sector. Of what lies above and below, a fan that turns and sends as
/// it receives needs what its main lobes hear by itself: `ahead`, which is in `off_plane`, too.
enum class SectorKind : std::size_t { lines, beside, off_plane, ahead };

inline double sector_middle(std::size_t sector) {
    return (static_cast<double>(sector) / (sectors_per_array - 1) - 0.5) * std::numbers::pi;
}

/// The angle counted in spacings of sectors, from the first one on.
inline double sector_place(double angle) {
    return (angle / std::numbers::pi + 0.5) * (sectors_per_array - 1);
}

/// `place`: of sector_place().
inline SectorShare sector_at_place(const FanPlan& plan, SectorKind kind, double place) {
    if (plan.beams.size() == 1) return {};
    const double first = std::clamp(std::floor(place), 0.0, static_cast<double>(sectors_per_array - 2));
    const std::size_t sector =
        static_cast<std::size_t>(kind) * sectors_per_array + static_cast<std::size_t>(first);
    return {static_cast<std::uint16_t>(sector), static_cast<float>(std::clamp(place - first, 0.0, 1.0))};
}

inline SectorShare sector_at(const FanPlan& plan, SectorKind kind, double angle) {
    return sector_at_place(plan, kind, sector_place(angle));
}

}  // namespace echoloop
