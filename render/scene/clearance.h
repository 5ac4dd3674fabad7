// How high a place is over what lies below it in a scene. A pure function; knows no sonar.
#pragma once

#include <optional>

#include "render/scene/scene.h"

namespace echoloop {

/// m, straight down from `place` to the first surface that faces up; nothing if there is none. What can move
/// is left out.
std::optional<double> clearance_below(const Scene& scene, Vec3 place);

}  // namespace echoloop
