// The patterns of one beam of a grid across and in elevation: main lobes as means over intervals, and where
// they end. Knows no pixels.
#pragma once

#include <vector>

#include "render/fan/lobe.h"
#include "render/fan/plan.h"

namespace echoloop {

/// A main lobe, zero beyond its edge.
class MainLobe {
  public:
    explicit MainLobe(const Lobe& lobe);
    /// Mean power over the angles low..high off the axis (low < high, rad).
    double mean(double low, double high) const { return (until(high) - until(low)) / (high - low); }
    double edge() const { return edge_; }  ///< rad
    double integral() const { return sums_.back(); }

  private:
    double until(double angle) const;

    double edge_, step_;
    std::vector<double> sums_;  ///< integrals from the lower edge on
};

struct GridLobes {
    explicit GridLobes(const FanGeometry& row);

    Lobe horizontal, vertical;
    MainLobe across, upwards;
};

}  // namespace echoloop
