// From how far beside its axis a beam hears an echo, bin by bin: which scatterers its speckle is of. Pure
// functions of mean powers; draws no numbers.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "render/echogram.h"

namespace echoloop {

/// Where a range cell is narrower than a beam, as on a floor that is seen obliquely, all beams around hear
/// the same scatterers, and so the same speckle; where it is wider, each hears those on its own axis. The
/// mean power tells: behind a main lobe exp(-k x^2) an echo lies d ln P / d bearing / (2 k) beside the axis.
class Lean {
  public:
    /// Mean powers of some beams, one a bin: those of beam n are row n % kept.
    struct Means {
        static constexpr std::size_t kept = 4;
        std::array<std::vector<float>, kept> rows;

        std::vector<float>& of(std::size_t beam) { return rows[beam % kept]; }
        const std::vector<float>& of(std::size_t beam) const { return rows[beam % kept]; }
    };

    /// `cell`: width of the cells of speckle, rad.
    Lean(const Shot& shot, double cell);

    /// False where beams are too few or too far apart to hear the same.
    bool any() const { return !beams_.empty(); }
    /// Bins in a stretch, of which all lean or none: a block of kernels::lean_block, or a few of them.
    struct Stretch {
        std::size_t first, count;
        bool leans;
    };
    /// All `bins` of a beam, cut into stretches of no more than `most` that lean, and those between them.
    /// None leans whose echo comes from so near to the beam's axis that it makes no difference. `means`: of
    /// the beams that lean_on() names at least; differences below `least` uPa^2 say nothing.
    void cut(std::size_t beam, const Means& means, float least, std::size_t bins, std::size_t most,
             std::vector<Stretch>& out) const;
    /// Writes to `out` how many cells beside its axis, clockwise positive, beam `beam` hears the bins [first,
    /// first + out.size()); never more than `most_widths`. `means` as above.
    void find(std::size_t beam, const Means& means, std::size_t first, std::span<float> out) const;
    /// The first and the last of the beams whose mean powers tell of that one, itself among them: three.
    std::pair<std::size_t, std::size_t> lean_on(std::size_t beam) const;

    static constexpr double most_widths = 1.5;  ///< there it hears next to nothing

  private:
    /// scale * ln(power of beam `over` / power of beam `under`)
    struct Term {
        std::size_t over = 0, under = 0;
        float scale = 0;
        float worth = 0;  ///< a ratio of powers that makes a difference
    };
    struct Beam {
        Term terms[2];  ///< the second is for the outermost beams
    };
    float most_;  ///< cells
    std::vector<Beam> beams_;
};

}  // namespace echoloop
