#include "render/paths/fan_pattern.h"

#include <algorithm>
#include <cmath>

namespace echoloop {

FanPattern::Key FanPattern::key_of(const Shot& shot) {
    return {shot.horizontal, shot.vertical,         shot.beam_width,
            shot.fan_height, shot.bearings.front(), shot.bearings.size() == 1};
}

FanPattern::FanPattern(const Shot& shot, const Effects& effects)
    : key_(key_of(shot)),
      side_lobes_(effects.has(Effect::side_lobes)),
      half_width_(shot.beam_width / 2),
      half_height_(shot.fan_height / 2) {
    if (!effects.has(Effect::beam_pattern)) return;
    horizontal_.emplace(shot.horizontal, shot.beam_width);
    vertical_.emplace(shot.vertical, shot.fan_height);
    half_width_ = std::max(half_width_, horizontal_->aperture().first_null());
    half_height_ = std::max(half_height_, vertical_->aperture().first_null());
}

bool FanPattern::fits(const Shot& shot) const { return key_ == key_of(shot); }

double FanPattern::amplitude(const std::optional<TwoWayPattern>& pattern, double edge, bool side_lobes,
                             double angle) {
    const bool inside = std::abs(angle) <= edge;
    if (!pattern) return inside ? 1 : 0;
    return inside || side_lobes ? pattern->amplitude(angle) : 0;
}

FanDirection FanPattern::at(Vec3 d) const {
    FanDirection out;
    out.bearing = std::atan2(-d.y, d.x);
    const double elevation = std::asin(std::clamp(d.z, -1.0, 1.0));
    out.transmit = amplitude(vertical_, half_height_, side_lobes_, elevation);
    out.receive = key_.vertical.ways == 2 || !vertical_ ? out.transmit : 1;
    if (!key_.single) return out;
    const double beside = std::remainder(out.bearing - key_.bearing, 2 * std::numbers::pi);
    const double across = amplitude(horizontal_, half_width_, side_lobes_, beside);
    out.receive *= across;
    if (key_.horizontal.ways == 2 || !horizontal_) out.transmit *= across;
    return out;
}

}  // namespace echoloop
