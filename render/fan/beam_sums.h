// From the echo of lines and sectors to that of beams: each beam weighs its own lines one by one and
// everything else by sector. Knows no pixels.
#pragma once

#include <functional>
#include <vector>

#include "render/fan/line_sums.h"
#include "render/fan/turned_lobe.h"
#include "render/fan/weighted_rows.h"
#include "render/workers.h"

namespace echoloop {

/// Whether the beams of a fan weigh lines by where these are heard, as its bearings turn.
bool turns_lines(const BinningInput& in);

class BeamSums {
  public:
    /// Fills `values` (beams x LineSums::length(), with the steps behind the bins); multiplies each bin with
    /// `gain` unless that is empty. A line that was sampled off its middle is weighed there, so that the mean
    /// over pings has the pattern itself. Beams of a fan that turns about its upright axis weigh lines by
    /// where they come from when they arrive, in stretches of range in which that is off by a tenth of a
    /// beam, or 0.025 deg; and so do the far sectors, by a tenth of their spacing.
    void sum(const BinningInput& in, LineSums& lines, const std::vector<float>& gain, Workers& workers,
             std::vector<float>& values);
    /// The same, but the sums of `count` beams from `first` on are handed over as `rows`, on the thread that
    /// made them and while they are in its processor's cache.
    using Take = std::function<void(std::size_t first, std::size_t count, float* rows)>;
    void sum_into(const BinningInput& in, LineSums& lines, const std::vector<float>& gain, Workers& workers,
                  const Take& take);

  private:
    void sum_far(const BinningInput& in, LineSums& lines, Workers& workers);
    void sum_some(const BinningInput& in, std::size_t first, std::size_t count, LineSums& lines,
                  const std::vector<float>& gain, float* out) const;
    static void sum_sectors(const FanPlan& plan, LineSums& lines, Workers& workers);
    /// The same of a fan that turns.
    void sum_turned_sectors(const BinningInput& in, LineSums& lines) const;
    void sum_nodes(const FarLobes& far, LineSums& lines, Workers& workers);
    void add_far(const FanPlan& plan, std::size_t beam, std::size_t k, std::vector<WeightedRow>& rows) const;
    /// Bins begin..end - 1, and where in bearing, rad, what comes from ahead arrives.
    struct Stretch {
        std::size_t begin, end;
        float turned;
    };

    /// In each of which it turns by `step` rad at most. `with_water`: the rows have the water's steps behind
    /// their bins.
    static std::vector<Stretch> stretches_of(const BinningInput& in, double step, bool with_water);
    static void add_steps_of_water(const BinningInput& in, std::vector<Stretch>& stretches);
    void sum_beams(const FanPlan& plan, std::size_t first, std::size_t count, std::size_t bins,
                   LineSums& lines, const float* gain, float* out) const;
    void sum_turned(const FanPlan& plan, std::size_t first, std::size_t count, std::size_t bins,
                    LineSums& lines, const float* gain, float* out) const;
    BeamLines turned_lines(const FanPlan& plan, const BeamLines& own, const BeamLines& last,
                           float turned) const;

    void find_bearings(const FanPlan& plan, PixelOffset offset);
    float weight_of(const FanPlan& plan, const BeamLines& own, std::size_t i) const;

    std::vector<float> bearings_;     ///< rad, where each level line was sampled
    TurnedLobe lobe_;                 ///< where anything turns
    std::vector<Stretch> stretches_;  ///< empty: nothing turns
    std::vector<float> nodes_;        ///< nodes x node_stride_
    std::size_t node_stride_ = 0;
    FilledBins filled_nodes_;
};

}  // namespace echoloop
