// What a shot's aperture makes of a direction: amplitude on transmission and on reception, and the bearing.
// Knows no scene.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "render/acoustics/pattern_table.h"
#include "render/echogram.h"
#include "render/effects.h"

namespace echoloop {

/// A direction as the aperture sees it.
struct FanDirection {
    double bearing = 0;                ///< rad, relative to Shot::pan, clockwise positive
    double elevation = 0;              ///< rad, over the fan's plane
    double transmit = 0, receive = 0;  ///< amplitude relative to the axis, -1..1
    double turned = 0;                 ///< rad, by which the sonar has turned in bearing since it sent
};

/// What the aperture makes of one, amplitude relative to the axis, -1..1.
struct FanWeights {
    double transmit = 0, receive = 0;
};

/// Which way of an axis with AxisPattern::ways == 1 is directive: horizontally the receiver (multibeam sonars
/// form their beams there), vertically the transmitter. Rows of beams (Shot::elevations) are formed by the
/// receiver both ways, and the transmitter fills them all alike: the pattern is 1 within their limits and 0
/// beyond. The horizontal pattern counts for a single beam only: those who share echoes among the beams of a
/// fan know theirs.
class FanPattern {
  public:
    FanPattern(const Shot& shot, const Effects& effects);

    /// Whether this is the pattern of `shot` too, so that it need not be made again.
    bool fits(const Shot& shot) const;
    /// `direction`: unit, in the frame of the fan: x along its axis, y to port, z up. By tables: within 0.02
    /// dB of the aperture's formula, both ways, where that is above -40 dB.
    FanDirection at(Vec3 direction) const;
    /// The same without its angles, which take longer than the rest.
    FanWeights weights(Vec3 direction) const;

    /// Of each beam across the fan; empty: a box.
    const std::optional<TwoWayPattern>& across() const { return horizontal_; }
    /// The same in elevation.
    const std::optional<TwoWayPattern>& upwards() const { return vertical_; }
    /// rad above and below the fan's plane, to the first nulls or the edge of the box.
    double half_height() const { return half_height_; }
    /// rad beside a beam's axis, the same.
    double half_width() const { return half_width_; }

  private:
    struct Key {
        AxisPattern horizontal, vertical;
        double beam_width, fan_height;
        std::vector<double> bearings;
        double lowest_row = 0, highest_row = 0;
        bool rows = false;
        friend bool operator==(const Key&, const Key&) = default;
    };
    static Key key_of(const Shot& shot);
    /// Multiplies what the one beam's aperture makes of the direction besides its elevation.
    void weigh_single(Vec3 direction, FanWeights& out) const;
    /// A quarter turn or more from every beam.
    bool is_behind(Vec3 direction) const;
    bool is_behind(double bearing) const;

    /// The angle up to which a beam hears without side lobes, as its sine.
    struct Edge {
        explicit Edge(double angle) : sine(angle < std::numbers::pi / 2 ? std::sin(angle) : 2) {}
        bool holds(double at) const { return std::abs(at) <= sine; }
        double sine;
    };
    /// A direction to a beam in the fan's plane.
    struct Heading {
        explicit Heading(double bearing) : x(std::cos(bearing)), y(-std::sin(bearing)) {}
        /// Of the angle to it, times the cosine of the elevation; the sine, clockwise, likewise.
        double cosine(Vec3 d) const { return d.x * x + d.y * y; }
        double sine(Vec3 d) const { return d.x * y - d.y * x; }
        double x, y;
    };

    Key key_;
    bool side_lobes_;
    std::optional<TwoWayPattern> horizontal_, vertical_;  ///< empty: boxes
    std::optional<PatternTable> across_, upwards_;        ///< of them; the first for a single beam only
    double half_width_, half_height_;
    Heading first_, last_;  ///< beams
    Edge beside_{0}, above_{0};
    double lowest_ = 0, highest_ = 0;  ///< sines of the elevations between which rows are lit
};

}  // namespace echoloop
