#include "emulator/pose/mount.h"

#include <cmath>
#include <numbers>

#include "emulator/pose/trajectory_file.h"

namespace echoloop {
namespace {

Pose swung(const MountSwing& swing, Time time) {
    if (swing.angle == 0) return {};
    const double angle = swing.angle * std::sin(2 * std::numbers::pi * to_seconds(time) / swing.period);
    const auto about = [&](MountSwing::Axis axis) { return swing.axis == axis ? angle : 0; };
    return {{},
            from_rpy(about(MountSwing::Axis::roll), about(MountSwing::Axis::pitch),
                     about(MountSwing::Axis::yaw))};
}

/// It swings about one of its own axes, so that the axis stays.
Motion swinging(const MountSwing& swing, Time time) {
    if (swing.angle == 0) return {};
    const double pace = 2 * std::numbers::pi / swing.period;
    const double rate = swing.angle * pace * std::cos(pace * to_seconds(time));
    const auto about = [&](MountSwing::Axis axis) { return swing.axis == axis ? rate : 0; };
    return {{},
            {about(MountSwing::Axis::roll), about(MountSwing::Axis::pitch), about(MountSwing::Axis::yaw)}};
}

}  // namespace

Mount::Mount(const Scenario& scenario, const ScenarioDevice& device, Clock& clock, StepServer* steps)
    : rest_(device.body_from_sonar), source_(device.mount_swing) {
    if (!device.mount_trajectory.empty()) source_ = read_trajectory(device.mount_trajectory);
    if (device.mount_input.empty()) return;
    source_ = Whereabouts(rest_, steps != nullptr);
    input_ = std::make_unique<PoseInput>(clock, device.mount_input, scenario.peers,
                                         &std::get<Whereabouts>(source_), steps);
}

void Mount::start() {
    if (input_) input_->start();
}

void Mount::close() {
    if (input_) input_->close();
}

void Mount::step(Time from, Time to) {
    if (auto* const where = std::get_if<Whereabouts>(&source_)) where->step(from, to);
}

Pose Mount::body_from_sonar(Time time) const {
    if (const auto* track = std::get_if<Track>(&source_)) return track->at(time)->pose;
    if (const auto* where = std::get_if<Whereabouts>(&source_)) return where->at(time).pose;
    return rest_ * swung(std::get<MountSwing>(source_), time);
}

Motion Mount::motion(Time time) const {
    if (const auto* track = std::get_if<Track>(&source_)) return track->motion(time);
    if (const auto* where = std::get_if<Whereabouts>(&source_)) return where->motion(time);
    return swinging(std::get<MountSwing>(source_), time);
}

std::optional<PoseSummary> Mount::summary() const {
    if (!input_) return {};
    PoseSummary summary = input_->summary();
    summary.jumps = std::get<Whereabouts>(source_).jumps();
    return summary;
}

}  // namespace echoloop
