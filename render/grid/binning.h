// From rendered pixels to received power per beam and bin of a grid. Plain CPU code, deterministic; knows no
// GL, no noise and no pulse.
#pragma once

#include <vector>

#include "render/fan/line_sums.h"
#include "render/grid/plan.h"

namespace echoloop {

/// Fills `values` (beams x bins) with what main lobes hear, before the gain of the bins. `in.plan` is
/// `plan.drawing`.
void bin_main_lobes(const BinningInput& in, const GridPlan& plan, Amount amount, std::vector<float>& values);

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
