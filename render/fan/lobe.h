// How a fan weighs directions along one axis: a box of the nominal width, or an aperture's two-way pattern.
// Knows no pixels and no scene.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "render/acoustics/stave_errors.h"

namespace echoloop {

class Lobe {
  public:
    /// Power 1 over `width` rad, nothing outside.
    static Lobe box(double width);
    /// The pattern of `axis`, -3 dB full width `width`. edge() is where the main lobe has fallen to
    /// `edge_power`.
    static Lobe pattern(AxisPattern axis, double width, double edge_power);
    /// From now on as a unit's array hears, whose staves differ; edge() stays. Not of a box.
    void set_errors(std::shared_ptr<const StaveErrors> errors) { errors_ = std::move(errors); }

    /// Mean two-way power, relative to the axis, over the angles low..high off the axis (low < high, rad).
    double mean(double low, double high) const;
    /// Two-way power at an angle off the axis.
    double power(double angle) const;
    /// rad off the axis: what lies within is drawn finely.
    double edge() const { return edge_; }
    bool is_box() const { return !pattern_; }

  private:
    double edge_ = 0;
    std::optional<TwoWayPattern> pattern_;
    std::shared_ptr<const StaveErrors> errors_;
};

/// The share of the interval low..high that lies within first..last.
double share_within(double low, double high, double first, double last);

}  // namespace echoloop
