// Samples of a regular grid, in rows, as the file has them. Knows nothing of places on the globe.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace echoloop::worlds {

struct GridPoint {
    std::int32_t x = 0, y = 0;  ///< column and row
    friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

struct Heights {
    std::int32_t width = 0, height = 0;
    std::vector<float> values{};  ///< m, height x width, upwards positive; NaN: nothing was measured there

    float at(GridPoint p) const {
        return values[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(p.x)];
    }
    float& at(GridPoint p) {
        return values[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(p.x)];
    }
    bool known(GridPoint p) const { return !std::isnan(at(p)); }
    /// All four corners of the cell between this sample and the next ones are known.
    bool solid(GridPoint cell) const {
        return known(cell) && known({cell.x + 1, cell.y}) && known({cell.x, cell.y + 1}) &&
               known({cell.x + 1, cell.y + 1});
    }
};

}  // namespace echoloop::worlds
