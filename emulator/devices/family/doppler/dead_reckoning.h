// Where a DVL believes to be: velocities summed up along an attitude that drifts. Axes: x forward, y to
// starboard, z down, at the last reset. Knows no message and no clock.
#pragma once

#include <optional>

#include "render/pose.h"

namespace echoloop::doppler {

struct LocalPosition {
    Vec3 position;                        ///< m
    double deviation = 0;                 ///< m, standard
    double roll = 0, pitch = 0, yaw = 0;  ///< rad
};

class DeadReckoning {
  public:
    /// Starts anew from where it is.
    void reset();
    /// As its sensors have it: `body` of axes x forward, y to starboard, z down, in any frame that stays.
    void attitude(const Quat& frame_from_body);
    /// By `velocity`, m/s in the body's axes, for `seconds`, known to `error` m/s.
    void moved(Vec3 velocity, double seconds, double error);
    /// It does not know how it moves.
    void unknown(double seconds);
    LocalPosition position() const;

  private:
    std::optional<Quat> reference_, now_;
    Vec3 position_;
    double variance_ = 0;  ///< m^2
};

}  // namespace echoloop::doppler
