// Where a sonar is on its vehicle at any time of the run: fixed, swinging about an axis, on a trajectory from
// a file, or as somebody outside says.
#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "emulator/pose/input.h"
#include "emulator/scenario/scenario.h"

namespace echoloop {

class Mount {
  public:
    /// Reads the trajectory or opens the input that the scenario names. `steps`: of a stepped run, else
    /// nullptr; outlives this. Throws StartError.
    Mount(const Scenario& scenario, const ScenarioDevice& device, Clock& clock, StepServer* steps);

    void start();
    void close();
    /// A stepped run moves on.
    void step(Time from, Time to);
    Pose body_from_sonar(Time time) const;
    /// On the vehicle.
    Motion motion(Time time) const;
    /// Empty unless poses come from outside.
    std::optional<PoseSummary> summary() const;

  private:
    Pose rest_;
    std::variant<MountSwing, Track, Whereabouts> source_;
    std::unique_ptr<PoseInput> input_;
};

}  // namespace echoloop
