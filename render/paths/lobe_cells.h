// How the main lobe of a fan is filled with rays: a grid of cells, one ray somewhere in each. Knows no scene.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/acoustics/pattern.h"
#include "render/echogram.h"

namespace echoloop {

/// Unit vector in the frame of the fan: x along its axis, y to port, z up.
inline Vec3 fan_direction(double bearing, double elevation) {
    const double level = std::cos(elevation);
    return {level * std::cos(bearing), -level * std::sin(bearing), std::sin(elevation)};
}

/// An angle whose sine and cosine are asked for again and again.
struct KnownAngle {
    KnownAngle() = default;
    explicit KnownAngle(double angle) : at(angle), sine(std::sin(angle)), cosine(std::cos(angle)) {}
    double at = 0, sine = 0, cosine = 1;  ///< rad first
};

/// As fan_direction().
inline Vec3 fan_direction(const KnownAngle& bearing, const KnownAngle& elevation) {
    return {elevation.cosine * bearing.cosine, -elevation.cosine * bearing.sine, elevation.sine};
}

/// Angles in rad, bearings relative to Shot::pan.
struct LobeCell {
    KnownAngle bearing, elevation;  ///< of its ray
    double first_bearing = 0, last_bearing = 0;
    KnownAngle low, high;    ///< elevations
    double solid_angle = 0;  ///< sr, that its ray stands for
};

class LobeCells {
  public:
    /// Cells over the beams' bearings and `half_width` rad beside them, `half_height` above and below the
    /// plane, or the rows: 512 for a fan, 64 for one beam, 2048 for rows, a few more where beams lie apart.
    /// `across`: the pattern of one beam, whose rays lie closer where it hears more, as its power one way,
    /// and stand for less there; null: evenly.
    LobeCells(const Shot& shot, double half_width, double half_height, const TwoWayPattern* across = nullptr);

    /// Puts the rays where a ping has them: by the low-discrepancy sequence R2 (Roberts 2018, "The
    /// unreasonable effectiveness of quasirandom sequences"), which goes on from ping to ping.
    void place(std::uint64_t ping);

    const std::vector<LobeCell>& cells() const { return cells_; }
    /// Whether a direction, unit and in the frame of the fan, is in any cell.
    bool contains(Vec3 direction) const;

  private:
    struct Interval {
        double first, last;
    };
    /// Places on one side of a beam's axis, as dense as its power one way.
    class DenseByPower {
      public:
        DenseByPower(const TwoWayPattern& across, double half_width);
        struct Place {
            double off, width;  ///< rad from the axis; rad that a ray there stands for
        };
        Place at(double share) const;

      private:
        static constexpr std::size_t parts = 32;
        double step_;
        std::array<double, parts> power_{};
        std::array<double, parts + 1> until_{};
    };

    std::vector<Interval> intervals_;
    double half_height_, axis_ = 0;
    std::optional<DenseByPower> dense_;
    std::uint64_t all_cells_;
    std::vector<LobeCell> cells_;
};

}  // namespace echoloop
