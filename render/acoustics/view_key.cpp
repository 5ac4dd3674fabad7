#include "render/acoustics/view_key.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/acoustics/random.h"

namespace echoloop {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

std::uint64_t step_of(double value, double step) {
    return static_cast<std::uint64_t>(std::llround(value / step));
}

bool far_apart(const Shot& shot) {
    for (std::size_t i = 1; i < shot.bearings.size(); ++i)
        if (shot.bearings[i] - shot.bearings[i - 1] < 0.9 * shot.beam_width) return false;
    return shot.bearings.size() > 1;
}

}  // namespace

ViewKey view_of(const Shot& shot, const Pose& world_from_sonar, double wavelength) {
    const Vec3 up = rotate(world_from_sonar.orientation, {0, 0, 1}), p = world_from_sonar.position;
    // The turn about the sonar's z axis is undefined where that points straight down, so heads that hang
    // upside down count theirs from a half roll. The border between the two is where few are mounted.
    const bool hangs = up.z < -0.3;
    const Quat upright =
        hangs ? world_from_sonar.orientation * Quat{0, 1, 0, 0} : world_from_sonar.orientation;
    const double twist = 2 * std::atan2(upright.z, upright.w), step = shot.fan_height / 4;
    std::uint64_t hash = hangs ? 1 : 0;
    for (const double coordinate : {p.x, p.y, p.z}) hash = mix(hash, step_of(coordinate, wavelength / 8));
    for (const double component : {up.x, up.y, shot.tilt}) hash = mix(hash, step_of(component, step));
    return {hash, hangs ? twist : -twist};
}

AngularGrid::AngularGrid(const Shot& shot)
    : count_(static_cast<std::uint32_t>(std::max(1.0, std::round(two_pi / (shot.beam_width / 2))))),
      blends_(!far_apart(shot)) {}

AngularCells AngularGrid::cells_of(double bearing) const {
    const double turns = bearing / two_pi, place = (turns - std::floor(turns)) * count_;
    if (!blends_) return {static_cast<std::uint32_t>(std::llround(place)) % count_, 0, 1, 0, 0};
    const auto cell = std::min(static_cast<std::uint32_t>(place), count_ - 1);
    const double share = place - cell, norm = std::hypot(1 - share, share);
    return {cell, (cell + 1) % count_, static_cast<float>((1 - share) / norm),
            static_cast<float>(share / norm), static_cast<float>(share)};
}

std::uint32_t AngularGrid::beside(std::uint32_t cell, int steps) const {
    const auto count = static_cast<std::int64_t>(count_);
    return static_cast<std::uint32_t>(((cell + steps) % count + count) % count);
}

double AngularGrid::cell_width() const { return two_pi / count_; }

}  // namespace echoloop
