#include "render/scene/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace echoloop {
namespace {

using Value = std::array<double, 4>;

Value value_of(const std::array<float, 4>& v) { return {v[0], v[1], v[2], v[3]}; }

template <typename Mix>
Value each(const Mix& mix) {
    return {mix(0), mix(1), mix(2), mix(3)};
}

double dot(const Value& a, const Value& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

Value unit(const Value& v) {
    const double length = std::sqrt(dot(v, v));
    if (!(length > 1e-9)) return {1, 0, 0, 0};  // a spline may run through zero
    return each([&](std::size_t i) { return v[i] / length; });
}

/// glTF 2.0, appendix C: linear rotations are spherical, by the shortest way.
Value spherical(const Value& a, const Value& b, double part) {
    const double cosine = dot(a, b), sign = cosine < 0 ? -1 : 1,
                 angle = std::acos(std::min(std::abs(cosine), 1.0));
    const bool near = angle < 1e-5;
    const double first = near ? 1 - part : std::sin((1 - part) * angle),
                 second = near ? part : std::sin(part * angle);
    return unit(each([&](std::size_t i) { return first * a[i] + sign * second * b[i]; }));
}

Value hermite(const KeyTrack& track, std::size_t key, double part, double step) {
    const auto at = [&](std::size_t k, std::size_t which) { return value_of(track.values[3 * k + which]); };
    const Value from = at(key, 1), out = at(key, 2), in = at(key + 1, 0), to = at(key + 1, 1);
    const double p2 = part * part, p3 = p2 * part;
    return each([&](std::size_t i) {
        return (2 * p3 - 3 * p2 + 1) * from[i] + step * (p3 - 2 * p2 + part) * out[i] +
               (3 * p2 - 2 * p3) * to[i] + step * (p3 - p2) * in[i];
    });
}

Vec3 translation_at(const NodeAnimation& a, double seconds) {
    if (!a.translation) return a.still_translation;
    const Value v = a.translation->at(seconds, false);
    return {v[0], v[1], v[2]};
}

Quat rotation_at(const NodeAnimation& a, double seconds) {
    if (!a.rotation) return a.still_rotation;
    const Value v = a.rotation->at(seconds, true);
    return {v[0], v[1], v[2], v[3]};
}

/// In the frame of the mover above, or the world.
Pose animated(const NodeAnimation& a, double seconds, Playback playback) {
    double at = std::min(seconds, a.duration);
    if (playback == Playback::loop && a.duration > 0) at = std::fmod(std::max(seconds, 0.0), a.duration);
    const Vec3 t = translation_at(a, at);
    return {a.origin + t.x * a.axes[0] + t.y * a.axes[1] + t.z * a.axes[2], a.turn * rotation_at(a, at)};
}

}  // namespace

Bounds empty_bounds() {
    constexpr float far = std::numeric_limits<float>::infinity();
    return {{far, far, far}, {-far, -far, -far}};
}

bool is_empty(const Bounds& bounds) { return bounds.min[0] > bounds.max[0]; }

void grow(Bounds& bounds, const std::array<float, 3>& point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        bounds.min[axis] = std::min(bounds.min[axis], point[axis]);
        bounds.max[axis] = std::max(bounds.max[axis], point[axis]);
    }
}

Bounds placed(const Bounds& bounds, const Pose& pose) {
    Bounds out = empty_bounds();
    if (is_empty(bounds)) return out;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const auto side = [&](unsigned axis) {
            return static_cast<double>(((corner >> axis) & 1U) != 0 ? bounds.max[axis] : bounds.min[axis]);
        };
        const Vec3 p = pose * Vec3{side(0), side(1), side(2)};
        grow(out, {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
    return out;
}

Value KeyTrack::at(double seconds, bool turns) const {
    const std::size_t per_key = way == Way::cubic ? 3 : 1, middle = way == Way::cubic ? 1 : 0;
    const auto still = [&](std::size_t key) {
        const Value value = value_of(values[per_key * key + middle]);
        return turns ? unit(value) : value;
    };
    const auto after = std::upper_bound(times.begin(), times.end(), static_cast<float>(seconds));
    if (after == times.begin()) return still(0);
    const auto key = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end() || way == Way::step) return still(key);
    const double from = times[key], step = static_cast<double>(*after) - from;
    const double part = std::clamp((seconds - from) / step, 0.0, 1.0);
    if (way == Way::cubic) {
        const Value value = hermite(*this, key, part, step);
        return turns ? unit(value) : value;
    }
    const Value a = still(key), b = still(key + 1);
    if (turns) return spherical(a, b, part);
    return each([&](std::size_t i) { return a[i] + part * (b[i] - a[i]); });
}

std::vector<Pose> mover_poses(std::span<const SceneMover> movers, double seconds, Playback playback,
                              std::span<const std::optional<Pose>> told) {
    std::vector<Pose> poses;
    poses.reserve(movers.size());
    for (std::size_t i = 0; i < movers.size(); ++i) {
        const SceneMover& mover = movers[i];
        if (i < told.size() && told[i]) {
            poses.push_back(*told[i]);
        } else if (mover.above == 0) {
            poses.push_back(mover.animation ? animated(*mover.animation, seconds, playback) : mover.rest);
        } else {
            const std::size_t above = mover.above - 1;
            poses.push_back(poses[above] * (mover.animation ? animated(*mover.animation, seconds, playback)
                                                            : inverse(movers[above].rest) * mover.rest));
        }
    }
    return poses;
}

}  // namespace echoloop
