#include "emulator/devices/imagenex-deltat/attitude.h"

#include <algorithm>

namespace echoloop::delta_t {
namespace {

constexpr double least_down = 0.7;  // of the axis; less looks ahead or aside

bool looks_down(const Pose& pose) { return rotate(pose.orientation, {1, 0, 0}).z < -least_down; }

}  // namespace

std::optional<Attitude> attitude_of(const Pose& pose) {
    if (!looks_down(pose)) return std::nullopt;
    const Vec3 bow = rotate(pose.orientation, {0, 0, 1}), port = rotate(pose.orientation, {0, 1, 0});
    const Vec3 axis = rotate(pose.orientation, {1, 0, 0});
    Attitude attitude;
    attitude.pitch = std::asin(std::clamp(bow.z, -1.0, 1.0));
    attitude.roll = std::atan2(port.z, -axis.z);
    attitude.heading = std::atan2(bow.x, bow.y);
    if (attitude.heading < 0) attitude.heading += 2 * std::numbers::pi;
    return attitude;
}

double down_bearing(const Pose& pose) {
    if (!looks_down(pose)) return 0;
    const Vec3 down = rotate(conjugate(pose.orientation), {0, 0, -1});
    return std::atan2(-down.y, down.x);
}

}  // namespace echoloop::delta_t
