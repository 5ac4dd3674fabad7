// The arrays of a sonar: beams that one plane of staves forms. A ping of several arrays, such as the two
// sides of a side-scan sonar, is a ping of each by itself, at the same time and place. Pure geometry; knows
// no scene.
#pragma once

#include <vector>

#include "render/echogram.h"

namespace echoloop {

/// What one array does in a ping.
struct ArrayShot {
    Shot shot;                   ///< of its beams alone
    Pose world_from_sonar;       ///< for `shot`
    std::size_t first_beam = 0;  ///< in the whole shot
};

/// Every beam has an array of its own where Shot::sides says so. Else beams belong to different arrays where
/// they are more than 20 widths, and more than 57 deg, apart. A shot of one array, or of rows of beams, stays
/// as it is; of several, each has its own axis at bearing 0, and its depression as tilt.
std::vector<ArrayShot> arrays_of(const Shot& shot, const Pose& world_from_sonar);

/// The key of what is a unit's own: its number where it has one, else that of the run's device.
inline std::uint64_t unit_of(const Shot& shot) {
    return shot.errors.unit != 0 ? shot.errors.unit : shot.random_key;
}

}  // namespace echoloop
