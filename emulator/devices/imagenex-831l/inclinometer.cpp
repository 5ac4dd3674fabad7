#include "emulator/devices/imagenex-831l/inclinometer.h"

#include <algorithm>
#include <cmath>

namespace echoloop::imagenex831l {
namespace {

constexpr double gravity = 9.80665;  // m/s^2

}  // namespace

Tilt felt(const Located& before, const Located& now) {
    const double seconds = to_seconds(now.time - before.time);
    const Vec3 gained = now.motion.velocity - before.motion.velocity;
    const Vec3 moved = seconds > 0 ? (1 / seconds / gravity) * gained : Vec3{};
    const Vec3 force = rotate(conjugate(now.world_from_device.orientation), moved + Vec3{0, 0, 1});
    return {force.y, -force.z};
}

Tilt sensed(const Tilt& truth, const Sensors& sensors, Time now) {
    return {sensors.read("roll acceleration", truth.roll, stray::acceleration, now),
            sensors.read("pitch acceleration", truth.pitch, stray::acceleration, now)};
}

double angle(double g) { return rad_to_deg(std::asin(std::clamp(g, -1.0, 1.0))); }

}  // namespace echoloop::imagenex831l
