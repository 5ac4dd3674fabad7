#include "render/grid/lobes.h"

#include <algorithm>
#include <cmath>

namespace echoloop {
namespace {

constexpr double edge_power = 1e-3;  ///< of a main lobe
constexpr std::size_t steps = 512;

Lobe lobe_of(const FanGeometry& g, AxisPattern axis, double width) {
    return g.patterns ? Lobe::pattern(axis, width, edge_power) : Lobe::box(width);
}

}  // namespace

MainLobe::MainLobe(const Lobe& lobe) : edge_(lobe.edge()), step_(2 * edge_ / steps), sums_{0} {
    for (std::size_t i = 0; i < steps; ++i)
        sums_.push_back(sums_.back() + step_ * lobe.power((static_cast<double>(i) + 0.5) * step_ - edge_));
}

double MainLobe::until(double angle) const {
    const double at = std::clamp((angle + edge_) / step_, 0.0, static_cast<double>(steps));
    const auto lower = std::min(static_cast<std::size_t>(at), steps - 1);
    return std::lerp(sums_[lower], sums_[lower + 1], at - static_cast<double>(lower));
}

GridLobes::GridLobes(const FanGeometry& row)
    : horizontal(lobe_of(row, row.horizontal, row.beam_width)),
      vertical(lobe_of(row, row.vertical, row.fan_height)),
      across(horizontal),
      upwards(vertical) {}

}  // namespace echoloop
