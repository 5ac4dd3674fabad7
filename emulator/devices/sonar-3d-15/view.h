// Which beams make an image: rows and columns in equal steps of angle, as the maker's formula has them.
// Geometry only; knows no host and no message.
#pragma once

#include <vector>

#include "emulator/devices/sonar-3d-15/settings.h"

namespace echoloop::sonar_3d_15 {

/// Beams of an image, a pixel each.
struct View {
    std::vector<double> bearings;    ///< rad, of the columns, from port to starboard
    std::vector<double> elevations;  ///< rad, of the rows, from the lowest to the highest
    bool first_row_up = false;

    /// Of a beam, row by row from the lowest; pixel 0 is the first of row 0.
    std::size_t pixel_of(std::size_t beam) const {
        const std::size_t row = beam / width, column = beam % width;
        return (first_row_up ? height - 1 - row : row) * width + column;
    }
};

View make_view(const ModeFigures& mode, bool first_row_up);

}  // namespace echoloop::sonar_3d_15
