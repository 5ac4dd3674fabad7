#include "emulator/devices/family/doppler/dead_reckoning.h"

#include <algorithm>
#include <cmath>

namespace echoloop::doppler {

void DeadReckoning::reset() {
    reference_ = now_;
    position_ = {};
    variance_ = 0;
}

void DeadReckoning::attitude(const Quat& frame_from_body) {
    now_ = frame_from_body;
    if (!reference_) reference_ = now_;
}

void DeadReckoning::moved(Vec3 velocity, double seconds, double error) {
    if (!now_) return;
    position_ = position_ + rotate(conjugate(*reference_) * *now_, seconds * velocity);
    variance_ += error * error * seconds * seconds;
}

void DeadReckoning::unknown(double seconds) {
    constexpr double usual_speed = 0.5;  // m/s, own choice
    const double deviation = std::sqrt(variance_) + usual_speed * seconds;
    variance_ = deviation * deviation;
}

LocalPosition DeadReckoning::position() const {
    LocalPosition p{position_, std::sqrt(variance_)};
    if (!now_) return p;
    const Quat q = conjugate(*reference_) * *now_;
    p.roll = std::atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y));
    p.pitch = std::asin(std::clamp(2 * (q.w * q.y - q.z * q.x), -1.0, 1.0));
    p.yaw = std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
    return p;
}

}  // namespace echoloop::doppler
