// From rendered pixels to received power per beam and bin of a grid. Plain CPU code, deterministic; knows no
// GL, no noise and no pulse.
#pragma once

#include <vector>

#include "render/fan/pixel_echoes.h"
#include "render/grid/plan.h"

namespace echoloop {

/// The bins of every beam, all 0, in `values` (beams x bins).
std::vector<LineBins> bins_of_beams(std::vector<float>& values, std::size_t beams, std::size_t bins);

/// Adds what main lobes hear of the field's pixels to the beams' bins, before the gain of the bins. In the
/// order of the pixels and on one thread: many pixels share a beam. `in.plan` is `plan.drawing`.
void add_main_lobes(const BinningInput& in, const GridPlan& plan, Amount amount,
                    std::vector<LineBins>& beams);

/// An echo of complete power that arrives along a beam.
struct Arrival {
    std::size_t beam;
    float near_range, far_range, power;  ///< m, m, uPa^2
};

class GridBinning {
  public:
    explicit GridBinning(Workers& workers) : workers_(workers) {}

    /// Fills `values` (beams x bins, see Echogram) as Binning::bin() does. `in.plan` is `plan.drawing`.
    void bin(const BinningInput& in, const GridPlan& plan, std::span<const Arrival> arrivals,
             std::vector<float>& values);

  private:
    void add_arrivals(const BinningInput& in, const BinGain& gain, std::span<const Arrival> arrivals);
    void sum_far(const GridPlan& plan);
    void add_surround(const BinningInput& in, const BinGain& gain, const GridPlan& plan);
    void finish(const GridPlan& plan, std::size_t bins, const std::vector<float>& gain,
                std::vector<float>& values);

    Workers& workers_;
    std::vector<LineBins> beams_;
    LineSums far_;  ///< those of GridFar
    std::vector<PixelEcho> echoes_;
    std::vector<float> shares_;
};

}  // namespace echoloop
