// A sonar that moves, and the effects by which that shows.
#pragma once

#include "tests/render/shots.h"

namespace echoloop::test {

inline RendererOptions patterned(bool motion = true) {
    RendererOptions options;
    options.effects = Effects::none()
                          .set(Effect::spreading)
                          .set(Effect::beam_pattern)
                          .set(Effect::side_lobes)
                          .set(Effect::motion, motion);
    return options;
}

inline Situation moving(Vec3 velocity, Vec3 turning_deg = {}) {
    Situation situation;
    situation.velocity = velocity;
    situation.turning = {deg_to_rad(turning_deg.x), deg_to_rad(turning_deg.y), deg_to_rad(turning_deg.z)};
    return situation;
}

}  // namespace echoloop::test
