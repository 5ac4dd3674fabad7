// The echoes of single pixels, for who shares them out otherwise than by line. Knows no beams.
#pragma once

#include <cstdint>
#include <vector>

#include "render/fan/line_sums.h"

namespace echoloop {

/// What one pixel adds: an amount from bin `near` to bin `far`, see LineBins::deposit().
struct PixelEcho {
    std::uint32_t sample;
    float near, far, amount, slope;
    bool of_water;  ///< the water's surface
};
/// The echoes of a line's pixels in their order, for those who share them out otherwise.
void list_echoes(const BinningInput& in, const BinGain& gain, Amount amount, const View& view,
                 std::size_t line, LineReader& reader, std::vector<PixelEcho>& echoes);

/// Moves what list_echoes() found to the ranges at which it appears where BinningInput::motion says that
/// those shift. `reader`: that has read the line.
void shift_echoes(const BinningInput& in, const View& view, std::size_t line, LineReader& reader,
                  std::vector<PixelEcho>& echoes);

}  // namespace echoloop
