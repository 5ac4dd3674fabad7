#include "render/fan/arrays.h"

#include <algorithm>

#include "render/acoustics/random.h"
#include "render/view.h"

namespace echoloop {
namespace {

constexpr double widest_gap = 20, least_gap = 1;  ///< beam widths, rad

bool is_new_array(const Shot& shot, std::size_t beam) {
    if (!shot.sides.empty()) return true;
    const double gap = shot.bearings[beam] - shot.bearings[beam - 1];
    return shot.elevations.empty() && gap > std::max(widest_gap * shot.beam_width, least_gap);
}

/// Beams first..last - 1, which are not all.
ArrayShot part_of(const Shot& shot, const Pose& world_from_sonar, std::size_t first, std::size_t last) {
    const double axis = (shot.bearings[first] + shot.bearings[last - 1]) / 2;
    ArrayShot array{shot, world_from_sonar, first};
    Shot& own = array.shot;
    own.bearings.assign(shot.bearings.begin() + static_cast<std::ptrdiff_t>(first),
                        shot.bearings.begin() + static_cast<std::ptrdiff_t>(last));
    for (double& bearing : own.bearings) bearing -= axis;
    own.pan = 0, own.tilt = 0;
    if (!shot.sides.empty()) {
        own.tilt = -shot.sides[first].depression;
        own.source_level = shot.sides[first].source_level;
        own.sides.clear();
    }
    own.errors.unit = mix(unit_of(shot), first + 1);
    array.world_from_sonar.orientation =
        world_from_sonar.orientation * sonar_from_fan(shot.pan, shot.tilt) * axis_angle({0, 0, 1}, -axis);
    return array;
}

}  // namespace

std::vector<ArrayShot> arrays_of(const Shot& shot, const Pose& world_from_sonar) {
    std::vector<ArrayShot> arrays;
    const std::size_t beams = shot.bearings.size();
    std::size_t first = 0;
    for (std::size_t beam = 1; beam < beams; ++beam)
        if (is_new_array(shot, beam)) {
            arrays.push_back(part_of(shot, world_from_sonar, first, beam));
            first = beam;
        }
    if (first == 0 && shot.sides.empty()) return {{shot, world_from_sonar, 0}};
    arrays.push_back(part_of(shot, world_from_sonar, first, beams));
    return arrays;
}

}  // namespace echoloop
