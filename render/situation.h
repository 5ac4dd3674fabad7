// Where everything is at the moment of a ping, and what is wanted of it beside its echo. Standard library
// only; knows no time and no scene.
#pragma once

#include <vector>

#include "render/motion.h"

namespace echoloop {

struct Situation {
    Situation() = default;
    /// A sonar in a scene in which everything is where the file puts it.
    Situation(const Pose& sonar) : world_from_sonar(sonar) {}  // a pose is the plainest situation
    Situation(Vec3 position, Quat orientation) : world_from_sonar{position, orientation} {}

    Pose world_from_sonar;  ///< at the transmission
    Vec3 velocity{};        ///< m/s, of the sonar in the world
    Vec3 turning{};         ///< rad/s, about the sonar's axes, right-handed
    /// world_from_object of Scene::movers(), in their order; what is missing at the end is where the file
    /// puts it.
    std::vector<Pose> movers;
    std::vector<Motion> mover_motions;  ///< of the same; what is missing at the end is at rest
    bool objects = false;               ///< Echogram::objects is wanted
    /// Factor on the number of pixels, 0.1..1: less will do for a faint background. Below 1 the echogram's
    /// truth tells of no surface nearer than the window.
    double detail = 1;
    /// Another one, 0.1..1, where there is no time for all pixels: more scatter, the same mean levels.
    double density = 1;
};

}  // namespace echoloop
