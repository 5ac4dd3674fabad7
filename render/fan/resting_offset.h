// Where the coarse pixels around a fan are sampled. Pure function; knows no ping.
#pragma once

#include <cstdint>

#include "render/view.h"

namespace echoloop {

/// A function of who looks, from where and in which direction, and not of the ping. So what side lobes hear
/// of a scene at rest stays as it is; a sonar that moves on samples it elsewhere, by a pixel for each metre
/// or degree of pan; and the mean over keys, or over a long way, sees a pixel's area.
PixelOffset resting_offset(std::uint64_t key, Vec3 position, double pan);

}  // namespace echoloop
