#include "emulator/pose/vehicle.h"

#include <spdlog/spdlog.h>

#include "emulator/pose/trajectory_file.h"

namespace echoloop {

Vehicle::Vehicle(const Scenario& scenario, Clock& clock, StepServer* steps, const ObjectWhereabouts& objects)
    : source_(scenario.world_from_body) {
    if (!scenario.trajectory.empty())
        source_ = read_trajectory(scenario.trajectory, scenario.origin);
    else if (!scenario.pose_input.empty() || steps != nullptr)
        source_ = Whereabouts(scenario.world_from_body, steps != nullptr);
    auto* const where = std::get_if<Whereabouts>(&source_);
    if (!scenario.pose_input.empty())
        inputs_.push_back(std::make_unique<PoseInput>(clock, scenario.pose_input, scenario.peers, where,
                                                      steps, objects, scenario.origin));
    if (!scenario.step_input.empty() && scenario.step_input != scenario.pose_input)
        inputs_.push_back(std::make_unique<PoseInput>(clock, scenario.step_input, scenario.peers, where,
                                                      steps, objects, scenario.origin));
}

void Vehicle::name_places(Scenario& scenario) const {
    if (!scenario.pose_input.empty()) scenario.pose_input = inputs_.front()->endpoint();
    if (!scenario.step_input.empty()) scenario.step_input = inputs_.back()->endpoint();
}

void Vehicle::start() {
    for (auto& input : inputs_) input->start();
}

void Vehicle::close() {
    for (auto& input : inputs_) input->close();
}

void Vehicle::step(Time from, Time to) {
    if (auto* const where = std::get_if<Whereabouts>(&source_)) where->step(from, to);
}

Pose Vehicle::world_from_body(Time time) const {
    if (const auto* track = std::get_if<Track>(&source_)) return track->at(time)->pose;
    if (const auto* pose = std::get_if<Pose>(&source_)) return *pose;
    return std::get<Whereabouts>(source_).at(time).pose;
}

void Vehicle::count_if_stale(Time time) {
    const auto* where = std::get_if<Whereabouts>(&source_);
    if (where != nullptr && where->at(time).stale && stale_pings_++ == 0)
        spdlog::warn("{}: no pose for more than a second; the vehicle is assumed to stand still",
                     inputs_.front()->summary().place);
}

Motion Vehicle::motion(Time time) const {
    if (const auto* track = std::get_if<Track>(&source_)) return track->motion(time);
    const auto* where = std::get_if<Whereabouts>(&source_);
    return where != nullptr ? where->motion(time) : Motion{};
}

std::optional<PoseSummary> Vehicle::summary() const {
    const auto* where = std::get_if<Whereabouts>(&source_);
    if (where == nullptr) return {};
    PoseSummary all;
    for (const auto& input : inputs_) {
        const PoseSummary one = input->summary();
        all.place += (all.place.empty() ? "" : " and ") + one.place;
        all.accepted += one.accepted;
        all.refused += one.refused;
        if (!one.last_refusal.empty()) all.last_refusal = one.last_refusal;
    }
    all.jumps = where->jumps();
    all.stale_pings = stale_pings_;
    return all;
}

}  // namespace echoloop
