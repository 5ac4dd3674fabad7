// Where the vehicle is at any time of the run: at rest, on a trajectory from a file, or as somebody outside
// says.
#pragma once

#include <variant>

#include "emulator/pose/input.h"
#include "emulator/scenario/scenario.h"

namespace echoloop {

class Vehicle {
  public:
    /// Reads the trajectory or opens the input that the scenario names. Throws StartError.
    Vehicle(const Scenario& scenario, Clock& clock);

    void start();
    void close();
    Pose world_from_body(Time time);
    /// Empty unless poses come from outside.
    std::optional<PoseSummary> summary() const;

  private:
    std::variant<Pose, Track, std::unique_ptr<PoseInput>> source_;
};

}  // namespace echoloop
