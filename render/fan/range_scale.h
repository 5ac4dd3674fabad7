// From a pixel's range to the bins of the window.
#pragma once

#include "render/fan/bin_gain.h"
#include "render/fan/binning.h"
#include "render/fan/line_echoes.h"

namespace echoloop {

/// m, of the window.
inline float end_of(const BinningInput& in) {
    return static_cast<float>(in.first_range + static_cast<double>(in.bins) * in.bin_length);
}

/// From m to bins, and what the gain of a whole bin leaves out.
class RangeScale {
  public:
    RangeScale(const BinningInput& in, const BinGain& gain)
        : gain_(gain),
          per_metre_(static_cast<float>(1 / in.bin_length)),
          start_(static_cast<float>(in.first_range / in.bin_length)),
          near_limit_(static_cast<float>(gain.near_limit())) {}

    bool is_near(float range) const { return range < near_limit_; }
    float near_limit() const { return near_limit_; }
    BinScale scale() const { return {per_metre_, start_}; }
    /// `length`: bins, over which the echo is spread.
    float correction(float range, float length) const {
        return range < near_limit_ && length < 1 ? gain_.correction(range) : 1;
    }

  private:
    const BinGain& gain_;
    float per_metre_, start_, near_limit_;
};

/// Close to the sonar the gain of a whole bin leaves something out of echoes at `range`, m.
inline void correct_near(const RangeScale& scale, const float* range, std::size_t samples,
                         LineEchoes& echoes) {
    if (!any_below(range, scale.near_limit(), samples)) return;
    for (std::size_t i = 0; i < samples; ++i)
        if (scale.is_near(range[i]) && echoes.amount[i] > 0)
            echoes.amount[i] *= scale.correction(range[i], echoes.high[i] - echoes.low[i]);
}

}  // namespace echoloop
