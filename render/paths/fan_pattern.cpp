#include "render/paths/fan_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace echoloop {

namespace {

/// Off the plane of symmetry of a line aperture, which cannot tell directions on a cone about it apart;
/// beyond a right angle where that is behind the aperture.
double cone(double bearing, double elevation) {
    const double angle = cone_angle(bearing, elevation);
    return std::abs(bearing) > std::numbers::pi / 2 ? std::copysign(std::numbers::pi, bearing) - angle
                                                    : angle;
}

}  // namespace

FanPattern::Key FanPattern::key_of(const Shot& shot) {
    Key key{shot.horizontal, shot.vertical, shot.beam_width, shot.fan_height, shot.bearings};
    key.rows = shot.rows() > 1;
    if (key.rows) key.lowest_row = shot.elevations.front(), key.highest_row = shot.elevations.back();
    return key;
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

bool FanPattern::is_behind(double bearing) const {
    const auto& beams = key_.bearings;
    const auto turned = [bearing](double beam) {
        return std::abs(std::remainder(bearing - beam, 2 * std::numbers::pi)) > std::numbers::pi / 2;
    };
    const auto after = std::ranges::lower_bound(beams, bearing);
    const bool between = after != beams.begin() && after != beams.end();
    if (between && *after - *(after - 1) < std::numbers::pi) return false;
    return turned(after == beams.end() ? beams.front() : *after) &&
           turned(after == beams.begin() ? beams.back() : *(after - 1));
}

FanDirection FanPattern::at(Vec3 d) const {
    FanDirection out;
    out.bearing = std::atan2(-d.y, d.x);
    out.elevation = std::asin(std::clamp(d.z, -1.0, 1.0));
    if (key_.rows) {
        const bool lit =
            out.elevation > key_.lowest_row - half_height_ && out.elevation < key_.highest_row + half_height_;
        out.transmit = out.receive = lit && !is_behind(out.bearing) ? 1 : 0;
        return out;
    }
    out.transmit = amplitude(vertical_, half_height_, side_lobes_, out.elevation);
    out.receive = key_.vertical.ways == 2 || !vertical_ ? out.transmit : 1;
    if (key_.bearings.size() > 1) {
        // An axis that is directive one way only is broad the other way, but not broader than the baffle lets
        // it.
        if (is_behind(out.bearing)) {
            const double behind = horizontal_ && side_lobes_ ? AperturePattern::back_amplitude : 0;
            out.transmit *= behind, out.receive *= behind;
        }
        return out;
    }
    weigh_single(out);
    return out;
}

void FanPattern::weigh_single(FanDirection& out) const {
    const double bearing = std::remainder(out.bearing - key_.bearings.front(), 2 * std::numbers::pi);
    if (key_.vertical.shape == ApertureShape::piston && vertical_) {
        const double off = std::acos(std::clamp(std::cos(bearing) * std::cos(out.elevation), -1.0, 1.0));
        out.transmit = amplitude(vertical_, half_height_, side_lobes_, off);
        out.receive = key_.vertical.ways == 2 ? out.transmit : 1;
        return;
    }
    const double across = amplitude(horizontal_, half_width_, side_lobes_,
                                    horizontal_ ? cone(bearing, out.elevation) : bearing);
    out.receive *= across;
    if (key_.horizontal.ways == 2 || !horizontal_) out.transmit *= across;
}

}  // namespace echoloop
