// From the echo of lines and sectors to that of beams: each beam weighs its own lines one by one and
// everything else by sector. Knows no pixels.
#pragma once

#include <vector>

#include "render/fan/line_sums.h"
#include "render/fan/weighted_rows.h"
#include "render/workers.h"

namespace echoloop {

class BeamSums {
  public:
    /// `offset`: where in the pixels the ping sampled; a line that lies off its middle is weighed there, so
    /// that the mean over pings has the pattern itself. Fills `values` (beams x bins); multiplies each bin
    /// with `gain` unless that is empty. `bins`: LineSums::stride(), with the steps behind the bins.
    void sum(const FanPlan& plan, PixelOffset offset, std::size_t bins, LineSums& lines,
             const std::vector<float>& gain, Workers& workers, std::vector<float>& values);

  private:
    void sum_sectors(const FanPlan& plan, LineSums& lines);
    void sum_nodes(const FarLobes& far, std::size_t bins, LineSums& lines, Workers& workers);
    void add_far(const FanPlan& plan, std::size_t beam, std::size_t k, std::size_t bins,
                 std::vector<WeightedRow>& rows) const;
    void sum_beams(const FanPlan& plan, std::size_t first, std::size_t count, std::size_t bins,
                   LineSums& lines, const float* gain, float* out) const;

    static void push(WeightedRow row, const LineSums& lines, std::size_t bins,
                     std::vector<WeightedRow>& rows);

    void find_bearings(const FanPlan& plan, PixelOffset offset);
    float weight_of(const FanPlan& plan, const BeamLines& own, std::size_t i) const;

    std::vector<float> bearings_;  ///< rad, where each level line was sampled
    std::vector<float> nodes_;     ///< nodes x bins
};

}  // namespace echoloop
