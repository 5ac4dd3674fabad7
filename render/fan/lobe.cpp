#include "render/fan/lobe.h"

#include <algorithm>
#include <cmath>

namespace echoloop {

double share_within(double low, double high, double first, double last) {
    return std::max(0.0, std::min(high, last) - std::max(low, first)) / (high - low);
}

Lobe Lobe::box(double width) {
    Lobe lobe;
    lobe.edge_ = width / 2;
    return lobe;
}

Lobe Lobe::pattern(AxisPattern axis, double width, double edge_power) {
    Lobe lobe;
    lobe.pattern_.emplace(axis, width);
    double inside = width / 2, outside = std::max(inside, lobe.pattern_->aperture().first_null());
    for (int step = 0; step < 40; ++step) {
        const double middle = (inside + outside) / 2;
        (lobe.pattern_->power(middle) > edge_power ? inside : outside) = middle;
    }
    lobe.edge_ = inside;
    return lobe;
}

double Lobe::power(double angle) const {
    if (errors_) {
        const double once = errors_->power(angle);
        return pattern_->ways() == 2 ? once * once : once;
    }
    return pattern_ ? pattern_->power(angle) : std::abs(angle) <= edge_ ? 1.0 : 0.0;
}

double Lobe::mean(double low, double high) const {
    if (!pattern_) return share_within(low, high, -edge_, edge_);
    const double middle = (low + high) / 2;  // Simpson's rule
    return (power(low) + 4 * power(middle) + power(high)) / 6;
}

}  // namespace echoloop
