// Where everything that moves in the scene is at any time of the run: on a trajectory from a file, as
// somebody outside says, by the scene's own animation, or at rest.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "emulator/pose/input.h"
#include "emulator/scenario/scenario.h"
#include "render/scene/scene.h"

namespace echoloop {

class Movers {
  public:
    /// Reads the trajectories that the scenario names. Throws StartError.
    Movers(const Scenario& scenario, std::shared_ptr<const Scene> scene);
    /// Opens the inputs that objects have of their own. `steps`: of a stepped run, else nullptr. Throws
    /// StartError.
    void open_inputs(const Scenario& scenario, Clock& clock, StepServer* steps);
    /// Those that lines of the vehicle's input may move.
    ObjectWhereabouts by_lines();

    /// As Vehicle's.
    void name_places(Scenario& scenario) const;
    void start();
    void close();
    /// A stepped run moves on.
    void step(Time from, Time to);

    /// Of each object that somebody outside moves, by name.
    std::map<std::string, PoseSummary> summary() const;

    /// world_from_object of all movers of the scene.
    std::vector<Pose> at(Time time);
    /// How they move in the world: by where they were shortly before. At rest exactly 0.
    std::vector<Motion> motions(Time time) const;
    /// m, from each mover's origin to its farthest point.
    std::vector<double> reach() const;

  private:
    /// What somebody outside tells of a thing.
    struct Told {
        Whereabouts where;
        bool placed = false;    ///< it has a place before the first word
        bool by_lines = false;  ///< of the vehicle's input
        PoseInput* input = nullptr;
        std::uint64_t stale_pings = 0;
    };
    /// Of one mover; std::monostate: an animation, or nothing.
    using Source = std::variant<std::monostate, Pose, Track, Told>;

    std::vector<Pose> poses(Time time) const;

    std::shared_ptr<const Scene> scene_;
    Playback playback_;
    std::vector<Source> sources_;
    std::vector<std::unique_ptr<PoseInput>> inputs_;
};

}  // namespace echoloop
