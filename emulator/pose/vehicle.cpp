#include "emulator/pose/vehicle.h"

#include "emulator/pose/trajectory_file.h"

namespace echoloop {

Vehicle::Vehicle(const Scenario& scenario, Clock& clock)
    : source_(scenario.world_from_body) {
    if (!scenario.trajectory.empty()) source_ = read_trajectory(scenario.trajectory);
    if (!scenario.pose_input.empty())
        source_ = std::make_unique<PoseInput>(clock, scenario.pose_input, scenario.world_from_body);
}

void Vehicle::start() {
    if (auto* input = std::get_if<std::unique_ptr<PoseInput>>(&source_)) (*input)->start();
}

void Vehicle::close() {
    if (auto* input = std::get_if<std::unique_ptr<PoseInput>>(&source_)) (*input)->close();
}

Pose Vehicle::world_from_body(Time time) {
    if (const auto* track = std::get_if<Track>(&source_)) return track->at(time)->pose;
    if (auto* input = std::get_if<std::unique_ptr<PoseInput>>(&source_)) return (*input)->at(time);
    return std::get<Pose>(source_);
}

std::optional<PoseSummary> Vehicle::summary() const {
    const auto* input = std::get_if<std::unique_ptr<PoseInput>>(&source_);
    return input == nullptr ? std::nullopt : std::optional((*input)->summary());
}

}  // namespace echoloop
