#include "render/image_rays.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "render/refraction.h"

namespace echoloop {
namespace {

double cosine_of(double sine) { return std::sqrt(std::max(0.0, 1 - sine * sine)); }

/// rad, of the line to where a ray is, over the elevation of the sine `from`; it leaves with the sine `up`,
/// for along d + rise upwards as RayTable::Place says.
double lift_from(const RayTable& rays, double from, double up, double length) {
    const RayTable::Place at = rays.place(static_cast<float>(up), static_cast<float>(length));
    const double along = static_cast<double>(at.along), cosine = cosine_of(from);
    const double x = along * cosine_of(up), y = along * up + static_cast<double>(at.rise);
    return std::atan2(y * cosine - x * from, x * cosine + y * from);
}

/// From as far above the surface as the profile reaches below it; constant beyond both ends.
std::vector<SoundSpeedPoint> unfolded(std::span<const SoundSpeedPoint> profile) {
    std::vector<SoundSpeedPoint> below{{0, sound_speed_at(profile, 0)}};
    std::ranges::copy_if(profile, std::back_inserter(below),
                         [](const SoundSpeedPoint& point) { return point.depth > 0; });
    below.push_back({below.back().depth + 1, below.back().speed});
    std::vector<SoundSpeedPoint> all;
    for (std::size_t i = below.size(); i-- > 1;) all.push_back({-below[i].depth, below[i].speed});
    all.insert(all.end(), below.begin(), below.end());
    return all;
}

}  // namespace

double lift_to(const RayTable& rays, double up, double length) { return lift_from(rays, up, up, length); }

std::shared_ptr<const RayTable> ImageTables::of(std::span<const SoundSpeedPoint> profile, double depth,
                                                double range) {
    const double step = std::max(0.0, std::round(2 * depth) / 2);
    return tables_.get([&](const auto& known) { return known->depth() == step && known->range() == range; },
                       [&] {
                           return std::pair(
                               std::make_shared<const RayTable>(unfolded(profile), step, range, false),
                               std::size_t{1});
                       });
}

const RayTable& ImageRays::table() const {
    if (!table_) table_ = tables_.of(own_.profile(), own_.depth(), own_.range());
    return *table_;
}

double ImageRays::refracted(double elevation, double ratio) {
    return std::copysign(std::acos(std::clamp(ratio * std::cos(elevation), -1.0, 1.0)), elevation);
}

BentRay ImageRays::to(double distance, double above) const {
    BentRay ray = table().at(distance, -above);
    const double line = std::atan2(above, distance), ratio = own_.speed() / table().speed();
    const double launch = line + ray.turn, own = refracted(launch, ratio);
    ray.bow += launch - own;
    ray.turn = own - line;
    ray.stretch = (1 + ray.stretch) * ratio - 1;
    return ray;
}

double ImageRays::lift(double up, double length) const {
    const double ratio = table().speed() / own_.speed();
    const double cosine = std::min(ratio * cosine_of(up), 1.0);
    return lift_from(table(), up, std::copysign(cosine_of(cosine), up), ratio * length);
}

}  // namespace echoloop
