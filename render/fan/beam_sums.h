// From the echo of lines and sectors to that of beams: each beam weighs its own lines one by one and everything else by
// sector. Knows no pixels.
#pragma once

#include <vector>

#include "render/fan/line_sums.h"
#include "render/workers.h"

namespace echoloop {

class BeamSums {
  public:
    /// Fills `values` (beams x bins); multiplies each bin with `gain` unless that is empty.
    void sum(const FanPlan& plan, std::size_t bins, LineSums& lines, const std::vector<float>& gain, Workers& workers,
             std::vector<float>& values);

  private:
    void sum_sectors(const FanPlan& plan, LineSums& lines);
    void sum_nodes(const FanPlan& plan, const FanPart& part, std::size_t bins, LineSums& lines, Workers& workers);
    void add_far(const FanPart& part, std::size_t beam, std::size_t bins, float* sum) const;

    std::vector<float> nodes_;  ///< of one part, nodes x bins
};

}  // namespace echoloop
