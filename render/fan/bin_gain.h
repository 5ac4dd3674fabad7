// What all echoes of one range bin have in common: source level, spreading and absorption. Knows no pixels.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "render/fan/binning.h"

namespace echoloop {

class BinGain {
  public:
    explicit BinGain(const BinningInput& in);

    const std::vector<float>& values() const { return values_; }

    /// gain at the range itself over that of its bin: what a bin's mean leaves out close to the sonar. 1
    /// farther away.
    float correction(float range) const;
    /// Multiplies by it the amounts of what is near and spread over less than a bin, within 5e-7. `range`: m;
    /// `low`, `high`: bins.
    void correct(const float* range, const float* low, const float* high, std::size_t count,
                 float* amount) const;
    /// m; beyond, correction() is within 0.2 % of 1.
    double near_limit() const { return 16 * length_; }

  private:
    double at(double range) const {
        return (spreading_ ? 1 / (range * range) : range * range) * std::exp(absorption_ * range);
    }

    double absorption_;
    bool spreading_;
    double first_, length_;
    std::vector<float> values_;
};

}  // namespace echoloop
