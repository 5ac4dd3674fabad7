#include "render/rays/chain_shooter.h"

#include <algorithm>
#include <cmath>

#include "render/layered_ray.h"
#include "render/refraction.h"

namespace echoloop::rays {

ChainShooter::ChainShooter(const RayTable& table, double sag)
    : levels_(endless_profile(table.profile(), 2.2 * table.range() + 10)),
      depth_(table.depth()),
      speed_(table.speed()),
      range_(table.range()),
      sag_(sag),
      surface_(table.surface()) {}

void ChainShooter::shoot(double elevation, double blur, std::vector<ChainPoint>& out) {
    points_ = &out;
    out.assign(1, {0, 0, 0, elevation, 0, 1 / speed_, speed_});
    snell_ = std::cos(elevation) / speed_;
    blur_ = std::abs(std::sin(elevation)) * blur + 1e-6;
    sine_ = std::abs(std::sin(elevation));
    start(elevation);
    for (int i = 0; i < most_layers && out.back().length < range_; ++i)
        if (!cross_layer()) break;
    if (out.size() == 1) go_straight(range_);
}

/// 1/s: layer i lies above levels_[i], the last one below all.
double ChainShooter::gradient(std::size_t layer) const {
    if (layer == 0 || layer == levels_.size()) return 0;
    const SoundSpeedPoint &a = levels_[layer - 1], &b = levels_[layer];
    return (b.speed - a.speed) / (b.depth - a.depth);
}

/// Chooses the layer and the way. Level rays go where sound is slower, if anywhere.
void ChainShooter::start(double elevation) {
    const auto below = std::ranges::upper_bound(levels_, depth_, {}, &SoundSpeedPoint::depth);
    layer_ = static_cast<std::size_t>(below - levels_.begin());
    const bool on_level = layer_ > 0 && levels_[layer_ - 1].depth == depth_;
    const double slope_below = gradient(layer_), slope_above = on_level ? gradient(layer_ - 1) : slope_below;
    down_ = elevation < 0 || (elevation == 0 && slope_below < 0);
    level_ = elevation == 0 && !(slope_below < 0) && !(slope_above > 0);
    if (!down_ && on_level) --layer_;
}

/// False where the ray ends.
bool ChainShooter::cross_layer() {
    const bool endless = down_ ? layer_ == levels_.size() : layer_ == 0;
    const ChainPoint& now = points_->back();
    if (level_ || endless || (sine_ < 1e-9 && gradient(layer_) == 0)) {
        go_straight(range_ - now.length);
        return false;
    }
    const SoundSpeedPoint& level = levels_[down_ ? layer_ : layer_ - 1];
    const double thickness = std::abs(level.depth - depth());
    if (snell_ * level.speed >= 1) {
        const double share = std::clamp((1 / snell_ - now.speed) / (level.speed - now.speed), 0.0, 1.0);
        if (share * thickness > 0 && sine_ > 0) go(share * thickness, 1 / snell_, 0);
        if (!down_ && surface_ && depth() < 0) return false;
        down_ = !down_, sine_ = 0;
        // What has not left its level would go to and fro.
        return points_->size() > 1 || gradient(layer_) != 0;
    }
    if (thickness > 0) go(thickness, level.speed, sine_of(snell_, level.speed));
    if (points_->back().length >= range_) return false;
    points_->back().z = depth_ - level.depth;
    cross(level.speed);
    return true;
}

/// Where the gradient changes, neighbours that come there at another angle are bent otherwise.
void ChainShooter::cross(double speed) {
    const std::size_t other = down_ ? layer_ + 1 : layer_ - 1;
    const double change = down_ ? gradient(other) - gradient(layer_) : gradient(layer_) - gradient(other);
    const double cosine = snell_ * speed;
    ChainPoint& now = points_->back();
    now.spread -= change * cosine * cosine / (speed * speed * std::sqrt(sine_ * sine_ + blur_)) * now.width;
    layer_ = other;
}

/// m of c t.
void ChainShooter::go_straight(double length) {
    ChainPoint next = points_->back();
    const double way = length * next.speed / speed_;
    next.x += way * std::cos(next.elevation), next.z += way * std::sin(next.elevation);
    next.length += length;
    next.width += next.spread * next.speed * way;
    points_->push_back(next);
}

/// To the place in the same layer that is `thickness` m off in depth, where sound has that speed.
void ChainShooter::go(double thickness, double speed, double sine) {
    const double from_speed = points_->back().speed, from_sine = sine_;
    const double from = std::atan2(from_sine, snell_ * from_speed), to = std::atan2(sine, snell_ * speed);
    const double chord =
        std::hypot(thickness, layer_step(snell_, thickness, from_speed, from_sine, speed, sine).distance);
    const double turn = std::abs(to - from);
    const auto parts = static_cast<int>(
        std::ceil(std::max({1.0, turn / most_turn, std::abs(speed - from_speed) / (most_change * speed_),
                            std::sqrt(chord * turn / (8 * sag_))})));
    double gone = 0;
    for (int part = 1; part <= parts && points_->back().length < range_; ++part) {
        const bool last = part == parts;
        const double angle = last ? to : from + (to - from) * part / parts;
        // By the change of sound speed, which the cosines tell, without a difference of them.
        const double share = last          ? 1
                             : turn < 1e-6 ? static_cast<double>(part) / parts
                                           : std::sin((angle + from) / 2) * std::sin((angle - from) / 2) /
                                                 (std::sin((to + from) / 2) * std::sin((to - from) / 2));
        const double part_speed = last ? speed : from_speed + share * (speed - from_speed);
        step(share * thickness - gone, part_speed, last ? sine : std::sin(angle), angle);
        gone = share * thickness;
    }
}

void ChainShooter::step(double thickness, double speed, double sine, double angle) {
    ChainPoint next = points_->back();
    const LayerStep way = layer_step(snell_, thickness, next.speed, sine_, speed, sine);
    const double half_turn = (angle - std::abs(next.elevation)) / 2;
    const double arc = std::hypot(thickness, way.distance) * (1 + half_turn * half_turn / 6);
    next.x += way.distance, next.z += down_ ? -thickness : thickness;
    next.length += speed_ * way.time;
    next.width += next.spread * arc * (next.speed + speed) / 2;
    next.elevation = down_ ? -angle : angle;
    next.speed = speed, sine_ = sine;
    points_->push_back(next);
}

}  // namespace echoloop::rays
