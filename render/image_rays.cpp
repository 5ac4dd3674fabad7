#include "render/image_rays.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "render/refraction.h"

namespace echoloop {
namespace {

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

double line_to(const RayTable& rays, double elevation, double length) {
    const auto up = static_cast<float>(std::sin(elevation));
    const RayTable::Place at = rays.place(up, static_cast<float>(length));
    return std::atan2(static_cast<double>(at.height(up)),
                      static_cast<double>(at.along) * std::cos(elevation));
}

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

double ImageRays::line(double elevation, double length) const {
    const double ratio = table().speed() / own_.speed();
    return line_to(table(), refracted(elevation, ratio), ratio * length);
}

}  // namespace echoloop
