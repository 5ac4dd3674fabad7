// How a body moves at one moment, and what that does to a frequency. Standard library only.
#pragma once

#include "render/pose.h"

namespace echoloop {

struct Motion {
    Vec3 velocity;  ///< m/s, in the frame that the body's pose is in
    Vec3 turning;   ///< rad/s, about the body's own axes, right-handed
    friend constexpr bool operator==(const Motion&, const Motion&) = default;
};

/// Of a body c that moves by `c` on a body b, which moves by `b` in a: that of c in a. At rest exactly 0.
constexpr Motion together(const Pose& a_from_b, const Motion& b, const Pose& b_from_c, const Motion& c) {
    return {b.velocity + rotate(a_from_b.orientation, cross(b.turning, b_from_c.position) + c.velocity),
            rotate(conjugate(b_from_c.orientation), b.turning) + c.turning};
}

/// Hz by which an echo is higher than `frequency` where sonar and scatterer close by `closing` m/s, both
/// ways.
constexpr double doppler_shift(double frequency, double closing, double sound_speed) {
    const double mach = closing / sound_speed;
    return frequency * ((1 + mach) / (1 - mach) - 1);
}

/// s: times the closing speed, the range by which the matched filter of an up-sweep over `bandwidth` Hz in
/// `pulse_length` s takes an echo for too near (range-Doppler coupling: frequency T / B). 0 below 5 ms, too
/// little to tell.
constexpr double sweep_bias(double frequency, double pulse_length, double bandwidth) {
    constexpr double least = 5e-3;
    const double bias = bandwidth > 0 ? frequency * pulse_length / bandwidth : 0;
    return bias > least ? bias : 0;
}

}  // namespace echoloop
