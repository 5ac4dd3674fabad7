// What the main lobes of a grid's beams hear of the field's pixels. Knows no side lobes.
#pragma once

#include <span>
#include <vector>

#include "render/fan/line_sums.h"
#include "render/fan/pixel_echoes.h"
#include "render/grid/plan.h"

namespace echoloop {

/// The bins of every beam, all 0, in `values` (beams x bins, or rows of `stride` that begin with the bins).
std::vector<LineBins> bins_of_beams(std::vector<float>& values, std::size_t beams, std::size_t bins,
                                    std::size_t stride = 0);

/// What the main lobes hear of the water: of every beam what is under way, and steps of the surface's echo.
struct WaterOfBeams {
    std::vector<UnderWay> under_way;
    std::vector<LineBins> surface;
};

/// What is heard from another pixel than the one that shows it, since the receiver has turned.
struct MovedEcho {
    PixelEcho echo;
    std::size_t pixel;  ///< of all of the plan's
};

/// Adds the field's pixels to the beams' bins, before the gain of the bins. In the order of the pixels and on
/// one thread: many pixels share a beam. `water`: added to where in.water is not null. `outside`: gets what
/// is heard from around the field, unless null.
void add_main_lobes(const BinningInput& in, const GridPlan& plan, Amount amount, std::vector<LineBins>& beams,
                    WaterOfBeams* water = nullptr, std::vector<MovedEcho>* outside = nullptr);
/// The same with what the surfaces in `in.wanted` send back, in these lines of the image, ascending.
void add_wanted(const BinningInput& in, const GridPlan& plan, std::span<const std::size_t> lines,
                std::vector<LineBins>& beams);

}  // namespace echoloop
