// Beam patterns of apertures: lines, shaded lines, pistons. Pure functions of angle; knows no scene and no
// bins.
#pragma once

#include <algorithm>
#include <cmath>

#include "render/echogram.h"

namespace echoloop {

/// One-way pattern of an aperture whose -3 dB full width is given.
///
/// line: sinc(L sin t / lambda); hamming: a line with Hamming shading; piston: 2 J1(x)/x, x = pi D sin t /
/// lambda (Urick, Principles of Underwater Sound, 1983, chapter 3). A line with Hamming shading is an array
/// of N = 32 elements, more where they would be farther apart than lambda / 2; its length is N times their
/// spacing.
class AperturePattern {
  public:
    /// `width`: rad, -3 dB full width, one way, 0 < width < pi.
    AperturePattern(ApertureShape shape, double width);
    /// `length`: L / lambda or D / lambda, more than 0; a short aperture falls by less than 3 dB up to 90
    /// deg.
    static AperturePattern of_length(ApertureShape shape, double length);
    /// The aperture whose amplitude is `level`, 0 < level < 1, at `angle` rad off the axis, 0 < angle <= pi
    /// / 2.
    static AperturePattern through(ApertureShape shape, double angle, double level);

    /// Amplitude relative to the axis, -1..1 (side lobes alternate in sign), at `angle` rad off the axis.
    /// Beyond
    /// +-90 deg the aperture is behind its baffle: back_amplitude times the mirrored value.
    double amplitude(double angle) const;
    /// The same in front of the aperture, at the sine of the angle.
    double at_sine(double sine) const;
    ApertureShape shape() const { return shape_; }
    /// L / lambda or D / lambda.
    double length_in_wavelengths() const { return length_; }
    /// rad, of the first null; pi / 2 where there is none.
    double first_null() const;

    static constexpr double back_amplitude = 0.01;  ///< -40 dB one way, own choice

  private:
    AperturePattern(ApertureShape shape, double length, int elements)
        : shape_(shape), length_(length), elements_(elements) {}
    ApertureShape shape_;
    double length_ = 0;
    int elements_ = 0;  ///< of the shaded array
};

/// A line array cannot tell directions on a cone about it apart: the angle of that cone, measured from the
/// array's plane of symmetry; the bearing itself in the fan's plane.
inline double cone_angle(double bearing, double elevation) {
    return std::asin(std::clamp(std::sin(bearing) * std::cos(elevation), -1.0, 1.0));
}

/// Transmit times receive pattern along one axis, made from the two-way -3 dB full width that a Shot gives.
class TwoWayPattern {
  public:
    TwoWayPattern(AxisPattern axis, double width);

    /// Power relative to the axis, 0..1: amplitude()^2 of one way, or its fourth power for two.
    double power(double angle) const;
    /// Amplitude of one way.
    double amplitude(double angle) const { return aperture_.amplitude(angle); }
    /// rad; the width of a box of power 1 that passes as much: the integral of power() over +-90 deg.
    double equivalent_width() const { return equivalent_; }
    const AperturePattern& aperture() const { return aperture_; }
    int ways() const { return ways_; }

  private:
    int ways_;
    AperturePattern aperture_;
    double equivalent_ = 0;
};

}  // namespace echoloop
