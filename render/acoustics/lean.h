// From how far beside its axis a beam hears an echo, bin by bin: which scatterers its speckle is of. Pure
// functions of mean powers; draws no numbers.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/echogram.h"

namespace echoloop {

/// Where a range cell is narrower than a beam, as on a floor that is seen obliquely, all beams around hear
/// the same scatterers, and so the same speckle; where it is wider, each hears those on its own axis. The
/// mean power tells: behind a main lobe exp(-k x^2) an echo lies d ln P / d bearing / (2 k) beside the axis.
class Lean {
  public:
    /// `cell`: width of the cells of speckle, rad.
    Lean(const Shot& shot, double cell);

    /// False where beams are too few or too far apart to hear the same.
    bool any() const { return !beams_.empty(); }
    /// Writes to `out` how many cells beside its axis, clockwise positive, beam `beam` hears the bins [first,
    /// first + out.size()); never more than `most_widths`. `means`: of all beams, beam-major; differences
    /// below `least` uPa^2 say nothing. False, with nothing written, where all of them come from so near to
    /// its axis that it makes no difference.
    bool find(std::size_t beam, std::span<const float> means, float least, std::size_t first,
              std::span<float> out) const;

    static constexpr double most_widths = 1.5;  ///< there it hears next to nothing

  private:
    /// scale * ln(power of beam `over` / power of beam `under`)
    struct Term {
        std::size_t over = 0, under = 0;
        float scale = 0;
    };
    struct Beam {
        Term terms[2];  ///< the second is for the outermost beams
    };
    std::size_t bins_;
    float most_;  ///< cells
    std::vector<Beam> beams_;
};

}  // namespace echoloop
