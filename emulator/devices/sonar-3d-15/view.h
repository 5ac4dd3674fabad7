// Which fans and beams make an image: a Shot is one fan, and its beams lie in a plane, while the rows of an
// image are cones. Geometry only; knows no host and no message.
#pragma once

#include <vector>

#include "emulator/devices/sonar-3d-15/settings.h"

namespace echoloop::sonar_3d_15 {

/// One pixel and the beam of its fan that it is taken from.
struct PixelBeam {
    std::size_t pixel, beam;
};

/// The fans of an image, tilted in equal steps as high as a row, from the lowest to the highest. In the
/// middle column each row has a fan at its elevation; elsewhere a pixel takes the nearest fan and in it the
/// nearest beam. No two pixels share a beam, and none is more than half a row and half a column off its axis.
struct View {
    std::vector<double> bearings;                ///< rad, of the beams of every fan
    std::vector<double> tilts;                   ///< rad, of the fans
    std::vector<std::vector<PixelBeam>> pixels;  ///< of each fan
};

/// Pixel 0 is the first of row 0; columns run from port to starboard.
View make_view(const ModeFigures& mode, bool first_row_up);

}  // namespace echoloop::sonar_3d_15
