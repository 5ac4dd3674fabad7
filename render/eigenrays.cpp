#include "render/eigenrays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/pose.h"
#include "render/refraction.h"

namespace echoloop {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();
constexpr std::size_t most_rays = 12;
constexpr double same_length = 2e-3, same_elevation = deg_to_rad(1.0);  // m, rad

bool same(std::span<const SoundSpeedPoint> a, std::span<const SoundSpeedPoint> b) {
    return std::ranges::equal(a, b, [](const SoundSpeedPoint& p, const SoundSpeedPoint& q) {
        return p.depth == q.depth && p.speed == q.speed;
    });
}

}  // namespace

Eigenrays::Eigenrays(const RayTable& table)
    : depth_(table.depth()),
      range_(table.range()),
      speed_(table.speed()),
      surface_(table.surface()),
      given_(table.profile().begin(), table.profile().end()),
      levels_(endless_profile(table.profile(), 2.2 * table.range() + 10)) {
    gradients_.push_back(0);
    for (std::size_t i = 1; i < levels_.size(); ++i)
        gradients_.push_back((levels_[i].speed - levels_[i - 1].speed) /
                             (levels_[i].depth - levels_[i - 1].depth));
    gradients_.push_back(0);
    // Rays turn where sound is fastest at the latest, and are steepest where it is slowest.
    double least = speed_, most = speed_;
    for (const SoundSpeedPoint& point : levels_)
        if (!surface_ || point.depth >= 0)
            least = std::min(least, point.speed), most = std::max(most, point.speed);
    if (surface_ && !given_.empty()) {
        const double top = sound_speed_at(levels_, 0);
        least = std::min(least, top), most = std::max(most, top);
    }
    steepest_ = std::acos(std::min(1.0, least / most));
    column_step_ = 1.1 * range_ / static_cast<double>(columns - 1);
    below_.assign(rows * columns, static_cast<float>(nowhere));
    for (std::size_t row = 0; row < rows; ++row) {
        const double elevation = row_elevation(static_cast<int>(row) - half),
                     snell = std::cos(elevation) / speed_;
        State ray = launched(elevation);
        float* out = &below_[row * columns];
        out[0] = 0;
        for (std::size_t column = 1; column < columns; ++column) {
            if (!advance(ray, snell, static_cast<double>(column) * column_step_, false)) break;
            if (surface_ && ray.highest < 0) break;
            out[column] = static_cast<float>(ray.depth - depth_);
        }
    }
}

bool Eigenrays::fits(const RayTable& table) const {
    return depth_ == table.depth() && range_ == table.range() && surface_ == table.surface() &&
           same(given_, table.profile());
}

/// Dense near level. A ray that does not turn may leave steeper than it leads on the whole.
double Eigenrays::row_elevation(int row) const {
    const double part = static_cast<double>(row) / half;
    return 1.5 * steepest_ * part * std::sqrt(std::abs(part));
}

/// The layer that a ray enters.
std::size_t Eigenrays::layer_of(double depth, double sine) const {
    const auto after = sine >= 0 ? std::ranges::upper_bound(levels_, depth, {}, &SoundSpeedPoint::depth)
                                 : std::ranges::lower_bound(levels_, depth, {}, &SoundSpeedPoint::depth);
    return static_cast<std::size_t>(after - levels_.begin());
}

double Eigenrays::speed_at(double depth, std::size_t layer) const {
    const SoundSpeedPoint& level = levels_[layer == levels_.size() ? layer - 1 : layer];
    return level.speed + gradients_[layer] * (depth - level.depth);
}

Eigenrays::State Eigenrays::launched(double elevation) const {
    State ray{.depth = depth_, .sine = -std::sin(elevation), .highest = depth_};
    ray.layer = layer_of(depth_, ray.sine);
    if (ray.sine == 0 && gradients_[ray.layer] > 0) ray.layer = layer_of(depth_, -1);
    return ray;
}

/// On a level with faster water above and below, where a level ray stays.
bool Eigenrays::between_faster(const State& ray) const {
    const auto is_least = [&](std::size_t level) {
        return levels_[level].depth == ray.depth && gradients_[level] <= 0 && gradients_[level + 1] >= 0;
    };
    return (ray.layer > 0 && is_least(ray.layer - 1)) || (ray.layer < levels_.size() && is_least(ray.layer));
}

/// To the horizontal distance `x`, by the arcs of its layers (Jensen et al. 2011, section 3.3): along an arc
/// the sine changes evenly with distance. False where it gets nowhere.
bool Eigenrays::advance(State& ray, double snell, double x, bool timed) const {
    constexpr int most_layers = 4096;
    for (int step = 0; step < most_layers; ++step) {
        const double gradient = gradients_[ray.layer], now = speed_at(ray.depth, ray.layer), left = x - ray.x;
        const double bend = gradient * snell;  // of the sine, per m
        const bool down = ray.sine > 0 || (ray.sine == 0 && gradient < 0);
        const bool stays = ray.sine == 0 && (gradient == 0 || between_faster(ray));
        const auto end_of = [&](bool below) -> const SoundSpeedPoint* {
            if (below) return ray.layer < levels_.size() ? &levels_[ray.layer] : nullptr;
            return ray.layer > 0 ? &levels_[ray.layer - 1] : nullptr;
        };
        const SoundSpeedPoint* end = stays ? nullptr : end_of(down);
        bool out_below = down;
        double sine = ray.sine, to_end = nowhere;
        if (end != nullptr && gradient == 0) {
            to_end = (end->depth - ray.depth) * snell * now / ray.sine;
        } else if (end != nullptr) {
            double cosine = snell * end->speed;
            if (cosine >= 1) out_below = !down, end = end_of(out_below), cosine = snell * end->speed;
            sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine))) * (out_below ? 1 : -1);
            to_end = std::max(0.0, (ray.sine - sine) / bend);
        }
        const bool arrives = to_end >= left;
        const double distance = arrives ? left : to_end;
        double next_sine = arrives ? ray.sine - bend * distance : sine;
        double depth = arrives || end == nullptr ? ray.depth : end->depth;
        if (arrives && gradient == 0) depth += distance * ray.sine / (snell * now);
        if (arrives && gradient != 0 && !stays)
            depth += distance * (ray.sine + next_sine) /
                     (std::sqrt(1 - ray.sine * ray.sine) + std::sqrt(1 - next_sine * next_sine));
        if (stays) next_sine = 0;
        if (ray.sine < 0 && next_sine > 0)  // it turns at the top
            ray.highest = std::min(ray.highest, ray.depth + (1 / snell - now) / gradient);
        if (timed)
            ray.time += gradient == 0 || stays ? distance / (now * now * snell)
                                               : (std::atanh(ray.sine) - std::atanh(next_sine)) / gradient;
        ray.x += distance, ray.sine = next_sine, ray.depth = depth;
        ray.highest = std::min(ray.highest, depth);
        if (arrives) return true;
        if (surface_ && ray.highest < 0) return false;
        ray.layer = out_below ? ray.layer + 1 : ray.layer - 1;
    }
    return false;
}

double Eigenrays::missed(double elevation, double distance, double below) const {
    State ray = launched(elevation);
    if (!advance(ray, std::cos(elevation) / speed_, distance, false)) return nowhere;
    return surface_ && ray.highest < 0 ? nowhere : ray.depth - depth_ - below;
}

void Eigenrays::course(double elevation, double distance, std::span<double> below) const {
    State ray = launched(elevation);
    const double snell = std::cos(elevation) / speed_;
    for (std::size_t i = 0; i < below.size(); ++i) {
        advance(ray, snell, static_cast<double>(i + 1) * distance, false);
        below[i] = ray.depth - depth_;
    }
}

float Eigenrays::depth_in_row(std::size_t row, double distance) const {
    const double place = distance / column_step_;
    const auto column = static_cast<std::size_t>(place);
    const float *at = &below_[row * columns + column],
                part = static_cast<float>(place) - static_cast<float>(column);
    return at[0] + part * (at[1] - at[0]);
}

/// Between two elevations on both sides of it. There is none where rays part.
Eigenrays::Found Eigenrays::add(double low, double high, double distance, double below,
                                std::vector<Eigenray>& out) const {
    constexpr double least = 1e-4;  // m
    double a = missed(low, distance, below), b = missed(high, distance, below), at = low, off = a;
    for (int round = 0; round < 40 && !(std::abs(off) < least); ++round) {
        if (!std::isfinite(a) || !std::isfinite(b) || a * b > 0) return Found::none;
        // By the straight line between both, and now and then in the middle.
        at = round % 3 == 2 ? (low + high) / 2 : low - a * (high - low) / (b - a);
        off = missed(at, distance, below);
        if (!std::isfinite(off)) return Found::none;
        if ((off < 0) == (a < 0))
            low = at, a = off;
        else
            high = at, b = off;
    }
    if (!(std::abs(off) < least)) return Found::none;
    State ray = launched(at);
    const double snell = std::cos(at) / speed_;
    advance(ray, snell, distance, true);
    const double length = speed_ * ray.time;
    // The tube of rays between two neighbours.
    constexpr double beside = 1e-5;  // rad
    const double width =
        (missed(at + beside, distance, below) - missed(at - beside, distance, below)) / (2 * beside);
    const double area = distance * std::abs(width) * std::sqrt(1 - ray.sine * ray.sine) / std::cos(at);
    const double focus = std::isfinite(width) ? std::clamp(length * length / area, 0.1, 10.0) : 1;
    const bool known = std::ranges::any_of(out, [&](const Eigenray& other) {
        return std::abs(other.length - length) < same_length &&
               std::abs(other.elevation - at) < same_elevation;
    });
    if (known) return Found::known;
    out.push_back({at, length, focus});
    return Found::added;
}

void Eigenrays::find(double distance, double below, std::vector<Eigenray>& out) const {
    out.clear();
    const bool steep = std::abs(std::atan2(below, distance)) > steepest_;
    if (steep || distance < column_step_ || distance >= column_step_ * static_cast<double>(columns - 2))
        return;
    const auto wanted = static_cast<float>(below);
    // From the steepest to level ones: near level, in a duct, there may be any number, which arrive together.
    constexpr int enough = 4;  // that are known, one after the other
    int known = 0;
    for (int step = half; step-- > 0 && known < enough;)
        for (const int side : {-1, 1}) {
            const int outer = side * (step + 1), inner = side * step;
            const float a = depth_in_row(static_cast<std::size_t>(outer + half), distance) - wanted,
                        b = depth_in_row(static_cast<std::size_t>(inner + half), distance) - wanted;
            if (!std::isfinite(a) || !std::isfinite(b) || (a < 0) == (b < 0) || out.size() == most_rays - 1)
                continue;
            const Found found = add(row_elevation(outer), row_elevation(inner), distance, below, out);
            known = found == Found::known ? known + 1 : 0;
        }
    if (below == 0 || known == enough) add(0, 0, distance, below, out);
    std::ranges::sort(out, {}, &Eigenray::length);
}

}  // namespace echoloop
