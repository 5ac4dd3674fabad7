// Patterns of apertures as tables over the sine of the angle off the axis, for who asks for thousands of
// directions a ping. Knows no scene and no beams.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "render/acoustics/pattern.h"

namespace echoloop {

/// One way, amplitude relative to the axis, in front of the aperture. Linear between its values, of which
/// there are 48 to a lobe: within 0.01 dB on the tops of all lobes and down to -20 dB on their flanks, and
/// within 2e-4 of the axis everywhere.
class PatternTable {
  public:
    static constexpr double per_lobe = 48;

    explicit PatternTable(const AperturePattern& aperture);

    /// `sine`: of the angle off the axis, -1..1.
    double at(double sine) const {
        const double place = std::min(std::abs(sine), 1.0) * per_sine_;
        const auto cell = static_cast<std::size_t>(place);
        const double share = place - static_cast<double>(cell), low = double{values_[cell]};
        return low + share * (double{values_[cell + 1]} - low);
    }

  private:
    double per_sine_;
    std::vector<float> values_;  ///< from the axis on, and one beyond the last
};

/// How many values such a table has from the axis to a right angle: some to each lobe, and enough for an
/// aperture without any.
inline std::size_t pattern_values(double length_in_wavelengths) {
    return std::max<std::size_t>(
        64, static_cast<std::size_t>(std::ceil(PatternTable::per_lobe * length_in_wavelengths)));
}

}  // namespace echoloop
