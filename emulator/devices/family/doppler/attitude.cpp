#include "emulator/devices/family/doppler/attitude.h"

#include <algorithm>
#include <cmath>

namespace echoloop::doppler {
namespace {

Vec3 about_z(Vec3 v, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

}  // namespace

Attitude attitude_of(const Quat& q) {
    const Vec3 forward = rotate(q, {1, 0, 0}), starboard = rotate(q, {0, 1, 0}), down = rotate(q, {0, 0, 1});
    return {.heading = std::atan2(forward.x, -forward.y),
            .pitch = std::asin(std::clamp(-forward.z, -1.0, 1.0)),
            .roll = std::atan2(starboard.z, down.z)};
}

Vec3 levelled(Vec3 v, const Attitude& a) {
    const double cr = std::cos(a.roll), sr = std::sin(a.roll);
    const Vec3 rolled{v.x, cr * v.y - sr * v.z, sr * v.y + cr * v.z};
    const double cp = std::cos(a.pitch), sp = std::sin(a.pitch);
    return {cp * rolled.x + sp * rolled.z, rolled.y, -sp * rolled.x + cp * rolled.z};
}

Vec3 in_world(Vec3 v, const Attitude& a) { return about_z(levelled(v, a), a.heading); }

}  // namespace echoloop::doppler
