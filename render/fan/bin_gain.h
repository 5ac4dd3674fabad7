// What all echoes of one range bin have in common: source level, spreading and absorption. Knows no pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/fan/binning.h"

namespace echoloop {

class BinGain {
  public:
    explicit BinGain(const BinningInput& in)
        : absorption_(-4 * in.absorption),
          spreading_(in.spreading),
          first_(in.first_range),
          length_(in.bin_length) {
        for (std::size_t bin = 0; bin < in.bins; ++bin)
            values_.push_back(
                static_cast<float>(in.source_power * mean(first_ + static_cast<double>(bin) * length_)));
    }

    const std::vector<float>& values() const { return values_; }

    /// gain at the range itself over that of its bin: what a bin's mean leaves out close to the sonar. 1
    /// farther away.
    float correction(float range) const {
        const double bin = std::floor((range - first_) / length_), low = first_ + bin * length_;
        return static_cast<float>(at(range) / mean(low));
    }
    /// m; beyond, correction() is within 0.2 % of 1.
    double near_limit() const { return 16 * length_; }

  private:
    double at(double range) const {
        return (spreading_ ? 1 / (range * range) : range * range) * std::exp(absorption_ * range);
    }
    double mean(double low) const { return at(std::max(low, 0.0) + length_ / 2); }

    double absorption_;
    bool spreading_;
    double first_, length_;
    std::vector<float> values_;
};

}  // namespace echoloop
