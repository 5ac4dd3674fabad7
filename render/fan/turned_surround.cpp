#include "render/fan/turned_surround.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "render/fan/binning.h"
#include "render/fan/far_lobes.h"
#include "render/fan/ping_motion.h"
#include "render/fan/plan_parts.h"

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
    SmoothLobe out{{step, {}}, {step, {}}, {power.step, {}}, ways == 2, static_cast<float>(spacing)};
    for (const double value : once) out.exact.values.push_back(static_cast<float>(value));
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
    : turns_(in.motion != nullptr && in.motion->turning != Vec3{}),
      plan_(&in.plan),
      view_(&view),
      line_(static_cast<double>(line)),
      offset_(in.offset.of(view)) {
    if (!turns_) return;
    const Quat array_from_fan = axis_angle({0, 0, 1}, plan_->centre),
               array_from_view = array_from_fan * view.fan_from_view();
    forward_ = rotate(array_from_view, {1, 0, 0});
    port_ = rotate(array_from_view, {0, 1, 0});
    up_ = rotate(array_from_view, {0, 0, 1});
    per_range_ = 2 * in.motion->slowness * rotate(array_from_fan, in.motion->turning);
    const double first = plan_->first_edge - plan_->centre, last = plan_->last_edge - plan_->centre;
    first_sector_ = sector_place(first), last_sector_ = sector_place(last);
    first_slope_ = std::tan(first), last_slope_ = std::tan(last);
    const View& level = plan_->views.front();
    edge_ = std::atan(level.top * std::cos(std::atan(level.right)));
    width_ = view.line_width() * view.usual_width, top_ = std::sin(edge_);
    constexpr double flat = 3;  // pixels
    flat_ = !plan_->far_upwards.empty() && plan_->geometry.fan_height < flat * width_;
    level_ = forward_ - view.x(line_ + 0.5 + offset_.line) * port_;
}

/// In pixels of the view, 1 long.
Vec3 TurnedSurround::along(double line, double sample) const {
    const Vec3 d = forward_ - view_->x(line) * port_ + view_->y(sample) * up_;
    return 1 / norm(d) * d;
}

/// Above and below the main lobe, where the surround takes over early, of beams that are not much higher than
/// a pixel: there both lobes change within it. Beside it the level views reach farther.
bool TurnedSurround::is_over_main_lobe(Vec3 sent) const {
    constexpr double pixels = 2;
    if (!flat_ || std::abs(sent.z) > top_ + pixels * width_) return false;
    return plan_->geometry.bearings.size() > 1 || (-sent.y > first_slope_ * sent.x - pixels * width_ &&
                                                   -sent.y < last_slope_ * sent.x + pixels * width_);
}

/// What the level views leave of a direction, as the plan of the surround has it.
double TurnedSurround::left_by_level_views(Vec3 sent) const {
    const bool ahead = -sent.y >= first_slope_ * sent.x && -sent.y <= last_slope_ * sent.x;
    if (!ahead || std::abs(sent.z) >= top_) return 1;
    return 1 - level_share_at(edge_, std::asin(sent.z));
}

/// Of one way or both, relative to the axis.
double TurnedSurround::both_lobes(Vec3 sent, Vec3 seen) const {
    const FanGeometry& g = plan_->geometry;
    const auto product = [](const SmoothLobe& lobe, double before, double after) {
        if (lobe.empty()) return 1.0;
        const auto at = [&](double sine) {
            return static_cast<double>(lobe.exact.at(static_cast<float>(sine)));
        };
        return lobe.both_ways ? at(before) * at(after) : at(after);
    };
    if (g.bearings.size() == 1 && g.vertical.shape == ApertureShape::piston)
        return product(plan_->far_upwards, std::hypot(sent.y, sent.z), std::hypot(seen.y, seen.z));
    return product(plan_->far_across, sent.y, seen.y) * product(plan_->far_upwards, sent.z, seen.z);
}

/// The mean over a pixel as the plan takes it, in the same places.
std::optional<float> TurnedSurround::kept_of_pixel(std::size_t sample, Vec3 turned) const {
    constexpr int parts = 4;
    double before = 0, after = 0;
    for (int i = 0; i < parts * parts; ++i) {
        const Vec3 sent =
            along(line_ + (i / parts + 0.5) / parts, static_cast<double>(sample) + (i % parts + 0.5) / parts);
        const double left = left_by_level_views(sent);
        if (left == 0) continue;
        before += left * both_lobes(sent, sent);
        after += left * both_lobes(sent, sent - cross(turned, sent));
    }
    if (!(before > 0)) return std::nullopt;
    return static_cast<float>(after / before);
}

Turned TurnedSurround::at(std::size_t sample, float range, float sector) const {
    const FanGeometry& g = plan_->geometry;
    const Vec3 turned = static_cast<double>(range) * per_range_;
    const Vec3 middle = level_ + view_->y(static_cast<double>(sample) + 0.5 + offset_.sample) * up_,
               sent = 1 / norm(middle) * middle, seen = sent - cross(turned, sent);
    const double s = -sent.y, s2 = -seen.y, u = sent.z, u2 = seen.z;
    const auto f = [](double value) { return static_cast<float>(value); };
    const bool piston = g.bearings.size() == 1 && g.vertical.shape == ApertureShape::piston;
    Turned out;
    const auto exact = is_over_main_lobe(sent) ? kept_of_pixel(sample, turned) : std::nullopt;
    if (exact)
        out.kept = *exact;
    else if (piston)
        out.kept = plan_->far_upwards.kept(f(std::hypot(s, u)), f(std::hypot(s2, u2)));
    else
        out.kept = plan_->far_across.kept(f(s), f(s2)) * plan_->far_upwards.kept(f(u), f(u2));
    if (g.bearings.size() == 1) return out;
    const auto cosine = [](double sine) { return std::sqrt(std::max(0.0, 1 - sine * sine)); };
    const double angle = s2 * cosine(s) - s * cosine(s2);  // its sine, but it is small
    if (!plan_->common_far.empty()) {
        out.far = plan_->common_far.at(f(angle));
        out.ahead = plan_->common_ahead.at(f(angle)) - out.far;
    }
    // A beam that sends as it receives hears best half-way.
    const double places = angle * (sectors_per_array - 1) / std::numbers::pi / g.horizontal.ways;
    const double heard = static_cast<double>(sector) + places;
    out.sectors = f(places), out.inside = heard > first_sector_ && heard < last_sector_;
    return out;
}

}  // namespace echoloop
