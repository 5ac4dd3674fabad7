#include "render/paths/fan_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace echoloop {

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
      half_height_(shot.fan_height / 2),
      first_(shot.bearings.front()),
      last_(shot.bearings.back()) {
    if (effects.has(Effect::beam_pattern)) {
        horizontal_.emplace(shot.horizontal, shot.beam_width);
        vertical_.emplace(shot.vertical, shot.fan_height);
        half_width_ = std::max(half_width_, horizontal_->aperture().first_null());
        half_height_ = std::max(half_height_, vertical_->aperture().first_null());
        if (!key_.rows) upwards_.emplace(vertical_->aperture());
        if (!key_.rows && shot.bearings.size() == 1) across_.emplace(horizontal_->aperture());
    }
    beside_ = Edge(half_width_), above_ = Edge(half_height_);
    const auto sine = [](double elevation) {
        return std::sin(std::clamp(elevation, -std::numbers::pi / 2, std::numbers::pi / 2));
    };
    lowest_ = sine(key_.lowest_row - half_height_), highest_ = sine(key_.highest_row + half_height_);
}

bool FanPattern::fits(const Shot& shot) const { return key_ == key_of(shot); }

bool FanPattern::is_behind(Vec3 d) const {
    if (key_.bearings.back() - key_.bearings.front() > std::numbers::pi)
        return is_behind(std::atan2(-d.y, d.x));
    return first_.cosine(d) < 0 && last_.cosine(d) < 0;
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
    const FanWeights heard = weights(d);
    return {std::atan2(-d.y, d.x), std::asin(std::clamp(d.z, -1.0, 1.0)), heard.transmit, heard.receive};
}

FanWeights FanPattern::weights(Vec3 d) const {
    FanWeights out;
    if (key_.rows) {
        const bool lit = d.z > lowest_ && d.z < highest_;
        out.transmit = out.receive = lit && !is_behind(d) ? 1 : 0;
        return out;
    }
    const bool inside = above_.holds(d.z);
    if (!vertical_)
        out.transmit = inside ? 1 : 0;
    else if (inside || side_lobes_)
        out.transmit = upwards_->at(d.z);
    out.receive = key_.vertical.ways == 2 || !vertical_ ? out.transmit : 1;
    if (key_.bearings.size() > 1) {
        // An axis that is directive one way only is broad the other way, but not broader than the baffle lets
        // it.
        if (is_behind(d)) {
            const double behind = horizontal_ && side_lobes_ ? AperturePattern::back_amplitude : 0;
            out.transmit *= behind, out.receive *= behind;
        }
        return out;
    }
    weigh_single(d, out);
    return out;
}

void FanPattern::weigh_single(Vec3 d, FanWeights& out) const {
    if (!horizontal_) {
        const double bearing =
            std::remainder(std::atan2(-d.y, d.x) - key_.bearings.front(), 2 * std::numbers::pi);
        const double across = std::abs(bearing) <= half_width_ ? 1 : 0;
        out.transmit *= across, out.receive *= across;
        return;
    }
    const bool in_front = first_.cosine(d) >= 0;
    const auto heard = [&](const PatternTable& table, const Edge& edge, double sine) {
        if (!side_lobes_ && !(in_front && edge.holds(sine))) return 0.0;
        return (in_front ? 1 : AperturePattern::back_amplitude) * table.at(sine);
    };
    const double beside = first_.sine(d);
    if (key_.vertical.shape == ApertureShape::piston) {
        out.transmit = heard(*upwards_, above_, std::sqrt(beside * beside + d.z * d.z));
        out.receive = key_.vertical.ways == 2 ? out.transmit : 1;
        return;
    }
    // A line aperture cannot tell directions on a cone about it apart.
    const double across = heard(*across_, beside_, beside);
    out.receive *= across;
    if (key_.horizontal.ways == 2) out.transmit *= across;
}

}  // namespace echoloop
