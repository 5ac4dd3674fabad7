// Where the vehicle is at any time of the run: at rest, on a trajectory from a file, or as somebody outside
// says.
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "emulator/pose/input.h"
#include "emulator/scenario/scenario.h"

namespace echoloop {

class Vehicle {
  public:
    /// Reads the trajectory and opens the inputs that the scenario names, also that of the clock. `steps`: of
    /// a stepped run, else nullptr; outlives this. Throws StartError.
    Vehicle(const Scenario& scenario, Clock& clock, StepServer* steps, const ObjectWhereabouts& objects = {});

    /// Writes the numbers of ports that the scenario leaves to the program into its inputs.
    void name_places(Scenario& scenario) const;
    void start();
    void close();
    /// A stepped run moves on.
    void step(Time from, Time to);
    Pose world_from_body(Time time) const;
    /// A ping at that time; counts those with a stale pose.
    void count_if_stale(Time time);
    /// In the world.
    Motion motion(Time time) const;
    /// Empty unless poses come from outside.
    std::optional<PoseSummary> summary() const;

  private:
    std::variant<Pose, Track, Whereabouts> source_;
    std::vector<std::unique_ptr<PoseInput>> inputs_;
    std::uint64_t stale_pings_ = 0;
};

}  // namespace echoloop
