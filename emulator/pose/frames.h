// From the axes of autopilots to the program's own: north-east-down and forward-right-down to ENU and FLU.
// A pure function.
#pragma once

#include "render/pose.h"

namespace echoloop {

inline Vec3 enu_from_ned(Vec3 v) { return {v.y, v.x, -v.z}; }
inline Vec3 flu_from_frd(Vec3 v) { return {v.x, -v.y, -v.z}; }

/// ENU and FLU from north-east-down and forward-right-down.
inline Pose enu_from_ned(const Pose& ned_from_frd) {
    const double half = std::sqrt(0.5);
    const Quat swap{0, half, half, 0};  // half a turn about the line between north and east
    const Quat frd_from_flu{0, 1, 0, 0};
    return {enu_from_ned(ned_from_frd.position), swap * ned_from_frd.orientation * frd_from_flu};
}

}  // namespace echoloop
