// Which view of the world a ping has: the key of its speckle. Pure functions; draws no numbers.
#pragma once

#include <cstdint>

#include "render/echogram.h"

namespace echoloop {

/// The same place and direction give the same view, one moved by lambda / 8 or more along any axis another
/// one.
struct ViewKey {
    std::uint64_t place = 0;  ///< hash of position, inclination and tilt
    double turn = 0;          ///< rad, of the sonar about its own z axis in the world, clockwise positive
};

/// Position in steps of lambda / 8; the direction of the sonar's z axis and the tilt in steps of a quarter of
/// the fan's height. `wavelength` in m.
ViewKey view_of(const Shot& shot, const Pose& world_from_sonar, double wavelength);

/// Speckle of a direction: of one angular cell, or between two, with weights whose squares add up to 1.
struct AngularCells {
    std::uint32_t first = 0, second = 0;
    float first_weight = 1, second_weight = 0;
    float place = 0;  ///< in cells beyond the first
};

/// How a shot's beams share angular cells of half a beam width round the circle, so that directions farther
/// apart than a beam width are independent and nearer ones are partly correlated. Beams 0.9 widths apart or
/// more get a cell each.
class AngularGrid {
  public:
    explicit AngularGrid(const Shot& shot);
    AngularCells cells_of(double bearing) const;  ///< rad, in the world
    /// `steps` cells farther clockwise.
    std::uint32_t beside(std::uint32_t cell, int steps) const;
    double cell_width() const;  ///< rad
    bool blends() const { return blends_; }

  private:
    std::uint32_t count_;
    bool blends_;
};

}  // namespace echoloop
