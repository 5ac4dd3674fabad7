// The echoes of the surround on their way to the sectors that hear them. Knows no pixels and no plan.
#pragma once

#include <cstdint>
#include <vector>

#include "render/fan/spread_echoes.h"

namespace echoloop {

class LineSums;

/// Of one line: collected, so that they are spread over bins all at once.
class SectorEchoes {
  public:
    /// Each to sector `first` + `sector`, and by the share `next` to the one behind it.
    void add(const EchoArrays& echoes, std::size_t first, const std::int32_t* sector, const float* next,
             std::size_t count);
    /// All to the first sector.
    void add(const EchoArrays& echoes, std::size_t count);
    void add(std::size_t sector, float near, float far, float amount) {
        sectors_.push_back(static_cast<std::int32_t>(sector));
        low_.push_back(near), high_.push_back(far), amount_.push_back(amount);
    }
    /// Adds all of them to the bins of their sectors, which do not know of it, and forgets them.
    void deposit(LineSums& sums);
    /// The same to the steps of the water's surface.
    void deposit_in_steps(LineSums& sums);

  private:
    void spread(std::size_t bins, std::size_t stride, float* rows);
    void clear();

    std::vector<std::int32_t> sectors_;
    std::vector<float> low_, high_, amount_, slope_;
    EchoSpreader spreader_;
};

}  // namespace echoloop
