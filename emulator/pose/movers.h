// Where everything that moves in the scene is at any time of the run: on a trajectory from a file, as
// somebody outside says, by the scene's own animation, or at rest.
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "emulator/pose/track.h"
#include "emulator/scenario/scenario.h"
#include "render/scene/scene.h"

namespace echoloop {

class Movers {
  public:
    /// Reads the trajectories that the scenario names. Throws StartError.
    Movers(const Scenario& scenario, std::shared_ptr<const Scene> scene);

    /// world_from_object of all movers of the scene.
    std::vector<Pose> at(Time time);
    /// m, from each mover's origin to its farthest point.
    std::vector<double> reach() const;

  private:
    /// Of one mover; std::monostate: an animation, or nothing.
    using Source = std::variant<std::monostate, Pose, Track>;

    std::shared_ptr<const Scene> scene_;
    Playback playback_;
    std::vector<Source> sources_;
};

}  // namespace echoloop
