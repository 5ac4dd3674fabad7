// How the main lobe of a fan is filled with rays: a grid of cells, one ray somewhere in each. Knows no scene.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "render/acoustics/pattern.h"
#include "render/echogram.h"

namespace echoloop {

/// Unit vector in the frame of the fan: x along its axis, y to port, z up.
inline Vec3 fan_direction(double bearing, double elevation) {
    const double level = std::cos(elevation);
    return {level * std::cos(bearing), -level * std::sin(bearing), std::sin(elevation)};
}

/// Angles in rad, bearings relative to Shot::pan.
struct LobeCell {
    double bearing = 0, elevation = 0;  ///< of its ray
    double first_bearing = 0, last_bearing = 0;
    double low = 0, high = 0;  ///< elevations
    double solid_angle = 0;    ///< sr, that its ray stands for
};

class LobeCells {
  public:
    /// Cells over the beams' bearings and `half_width` rad beside them, `half_height` above and below the
    /// plane, or the rows: 512 for a fan, 64 for one beam, 2048 for rows, a few more where beams lie apart.
    /// Rays are placed by the low-discrepancy sequence R2 (Roberts 2018, "The unreasonable effectiveness of
    /// quasirandom sequences"), which goes on from ping to ping. `across`: the pattern of one beam, whose
    /// rays lie closer where it hears more, as its power one way, and stand for less there; null: evenly.
    LobeCells(const Shot& shot, double half_width, double half_height, const TwoWayPattern* across = nullptr);

    const std::vector<LobeCell>& cells() const { return cells_; }
    /// Whether a direction is in any cell.
    bool contains(double bearing, double elevation) const;

  private:
    struct Interval {
        double first, last;
    };
    std::vector<Interval> intervals_;
    double half_height_;
    std::vector<LobeCell> cells_;
};

}  // namespace echoloop
