// Where the scatterers lie that a sonar's beams hear: in angular cells round its axis, whose speckle moves
// with the sonar. A function of the pose, not of how it came there. Draws no numbers.
#pragma once

#include <cstdint>

#include "render/acoustics/lean.h"
#include "render/echogram.h"

namespace echoloop {

/// Cells of 0.7 beam widths round the circle: nearer ones would cost more numbers, of wider ones the
/// correlation of two beams would depend on where they lie by more than 0.03.
class AngularGrid {
  public:
    explicit AngularGrid(double beam_width);  ///< rad
    /// Cells from the reference to a direction (rad, clockwise), 0 <= place < the circle.
    double place_of(double bearing) const;
    /// `steps` cells farther clockwise.
    std::uint32_t beside(std::uint32_t cell, int steps) const;
    double cell_width() const;  ///< rad

  private:
    std::uint32_t count_;
};

/// How a beam hears the cells round its place. White numbers, weighed so, correlate between directions as
/// beams do that share their staves.
struct BeamKernel {
    double reach = 2.4;  ///< cells, beyond which it hears nothing
    double middle = -1;  ///< the weight is (1 - s)^2 (1 + middle s), s = (distance / reach)^2

    double weight(double distance) const;
    /// Cells on either side of the one where a place lies, the place at its beginning.
    int cells() const { return static_cast<int>(reach) + 1; }
    bool operator==(const BeamKernel&) const = default;
};

/// Of the echo; `looks` in a bin. Wide transmit: beams share what one aperture's weights w let them share;
/// both ways: w convolved with itself.
BeamKernel echo_kernel(const Shot& shot, double looks);
/// Of the noise, which is heard one way.
BeamKernel noise_kernel(const Shot& shot, double looks);

/// Two layers of white numbers that a cell is of at a place of the sonar, and from which range on.
struct CellView {
    std::uint64_t layer = 0;            ///< the other is the next
    float weight = 1, next_weight = 0;  ///< their squares add up to 1
    double shift = 0;                   ///< m that the sonar has moved towards the cell
};

class ScattererView {
  public:
    ScattererView() = default;
    /// `wavelength` in m.
    ScattererView(const Shot& shot, const Pose& world_from_sonar, double wavelength);

    /// rad, from the cells' reference to the sonar's own bearing 0, clockwise.
    double turn() const { return turn_; }
    /// Of the cell around that direction from the reference (rad).
    CellView of(std::uint32_t cell, double direction) const;
    /// Of all its cells: which way the sonar is mounted.
    std::uint64_t key() const { return static_cast<std::uint64_t>(mounting_); }

  private:
    enum class Mounting { upright, hanging, lying };
    Mounting mounting_ = Mounting::upright;
    double turn_ = 0, tilt_ = 0;
    Vec3 position_, up_;
    double pace_[2] = {0, 0};        ///< layers a metre across a beam, of two kinds of cells
    double level_pace_[2] = {0, 0};  ///< the same of level ways, where it lies
    double angle_pace_ = 0;          ///< layers a radian out of the fan's plane
};

}  // namespace echoloop
