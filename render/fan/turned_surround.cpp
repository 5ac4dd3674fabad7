#include "render/fan/turned_surround.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "render/fan/binning.h"
#include "render/fan/far_lobes.h"
#include "render/fan/ping_motion.h"

namespace echoloop {
namespace {

/// The integral of a table from 0 on, by trapezoids; odd.
class Integral {
  public:
    Integral(double step, std::vector<double> values) : step_(step), values_(std::move(values)), sums_{0} {
        for (std::size_t i = 1; i < values_.size(); ++i)
            sums_.push_back(sums_.back() + step_ / 2 * (values_[i - 1] + values_[i]));
    }
    double mean(double low, double high) const { return (until(high) - until(low)) / (high - low); }

  private:
    double until(double at) const {
        const double place = std::min(std::abs(at) / step_, static_cast<double>(values_.size() - 1));
        const std::size_t cell = std::min(static_cast<std::size_t>(place), values_.size() - 2);
        const double share = place - static_cast<double>(cell);
        const double here = std::lerp(values_[cell], values_[cell + 1], share);
        return std::copysign(sums_[cell] + share * step_ / 2 * (values_[cell] + here), at);
    }

    double step_;
    std::vector<double> values_, sums_;
};

}  // namespace

SmoothLobe smooth_lobe(const LobeTable& power, int ways, double width, double spacing) {
    std::vector<double> once, squares;
    for (const float value : power.values) {
        const double both = static_cast<double>(value);
        once.push_back(ways == 2 ? std::sqrt(both) : both);
        squares.push_back(once.back() * once.back());
    }
    const Integral first(power.step, once), second(power.step, squares);
    const double step = std::max(power.step, width / 16);
    SmoothLobe out{{step, {}}, {step, {}}, ways == 2, static_cast<float>(spacing)};
    for (double sine = 0; sine < 1 + 2 * step; sine += step) {
        const double at = std::min(sine, 1 - width / 2);
        out.power.values.push_back(static_cast<float>(first.mean(at - width / 2, at + width / 2)));
        out.square.values.push_back(static_cast<float>(second.mean(at - width / 2, at + width / 2)));
    }
    return out;
}

float SmoothLobe::kept(float before, float after) const {
    constexpr float least = 1e-12F;
    if (empty()) return 1;
    const float g1 = power.at(before), g2 = power.at(after);
    if (!both_ways) return g2 / std::max(g1, least);
    const float v1 = std::max(square.at(before) - g1 * g1, 0.0F),
                v2 = std::max(square.at(after) - g2 * g2, 0.0F);
    constexpr float turn = 2 * std::numbers::pi_v<float>;
    const float heard = g1 * g2 + std::cos(turn * (after - before) / spacing) * std::sqrt(v1 * v2);
    return std::max(heard, 0.0F) / std::max(square.at(before), least);
}

TurnedSurround::TurnedSurround(const BinningInput& in, const View& view, std::size_t line)
    : turns_(in.motion != nullptr && in.motion->turning != Vec3{}), plan_(&in.plan) {
    if (!turns_) return;
    const Quat array_from_fan = axis_angle({0, 0, 1}, plan_->centre),
               array_from_view = array_from_fan * view.fan_from_view();
    const PixelOffset offset = in.offset.of(view);
    level_ = rotate(array_from_view, {1, -view.x(static_cast<double>(line) + 0.5 + offset.line), 0});
    up_ = rotate(array_from_view, {0, 0, 1});
    per_range_ = 2 * in.motion->slowness * rotate(array_from_fan, in.motion->turning);
    top_ = view.y(0.5 + offset.sample), step_ = view.sample_height();
    first_sector_ = sector_place(plan_->first_edge - plan_->centre),
    last_sector_ = sector_place(plan_->last_edge - plan_->centre);
}

Turned TurnedSurround::at(std::size_t sample, float range, float sector) const {
    const FanGeometry& g = plan_->geometry;
    const Vec3 along = level_ + (top_ - static_cast<double>(sample) * step_) * up_;
    const Vec3 sent = 1 / norm(along) * along,
               seen = sent - static_cast<double>(range) * cross(per_range_, sent);
    const double s = -sent.y, s2 = -seen.y, u = sent.z, u2 = seen.z;
    const auto f = [](double value) { return static_cast<float>(value); };
    Turned out;
    if (g.bearings.size() == 1 && g.vertical.shape == ApertureShape::piston) {
        out.kept = plan_->far_upwards.kept(f(std::hypot(s, u)), f(std::hypot(s2, u2)));
        return out;
    }
    out.kept = plan_->far_across.kept(f(s), f(s2)) * plan_->far_upwards.kept(f(u), f(u2));
    if (g.bearings.size() == 1) return out;
    const auto cosine = [](double sine) { return std::sqrt(std::max(0.0, 1 - sine * sine)); };
    const double angle = s2 * cosine(s) - s * cosine(s2);  // its sine, but it is small
    // A beam that sends as it receives hears best half-way.
    const double turned = angle * (sectors_per_array - 1) / std::numbers::pi / g.horizontal.ways;
    const double heard = static_cast<double>(sector) + turned;
    out.sectors = f(turned), out.inside = heard > first_sector_ && heard < last_sector_;
    return out;
}

}  // namespace echoloop
