#include "emulator/scenario/mount_section.h"

#include "emulator/scenario/objects_section.h"
#include "emulator/scenario/pose_section.h"

namespace echoloop::scenario {
namespace {

MountSwing read_swing(const Value* value, const std::string& path, Problems& problems) {
    const Section section(value, path, {"axis", "angle_deg", "period"}, problems);
    MountSwing swing;
    const std::string axis = section.word("axis", "pitch", {"roll", "pitch", "yaw"});
    swing.axis = axis == "roll"  ? MountSwing::Axis::roll
                 : axis == "yaw" ? MountSwing::Axis::yaw
                                 : MountSwing::Axis::pitch;
    swing.angle = deg_to_rad(section.number("angle_deg", 20, {0, 180, "deg"}));
    swing.period = section.number("period", 5, {0.05, 86400, "s"});
    return swing;
}

/// It moves in one way only, and a trajectory leaves nothing to say about its place.
void refuse_contradictions(const Section& mount, Problems& problems) {
    const Value* first = nullptr;
    for (const std::string_view way : {"swing", "trajectory", "input"}) {
        const Value* const value = mount.get(way);
        if (value != nullptr && first != nullptr)
            problems.add(value->key_place, mount.path_of(way) +
                                               ": the mount moves in two ways; keep one of "
                                               "swing, trajectory and input");
        if (value != nullptr) first = value;
    }
    if (mount.get("trajectory") == nullptr) return;
    for (const std::string_view key : {"position", "rpy_deg"})
        if (const Value* const value = mount.get(key))
            problems.add(value->key_place,
                         mount.path_of(key) + ": the trajectory says where the sonar is; remove this");
}

}  // namespace

void read_mount(const Value* value, const std::string& path, const Scenario& scenario, ScenarioDevice& device,
                Problems& problems) {
    const Section mount(value, path, {"position", "rpy_deg", "swing", "trajectory", "input"}, problems);
    device.body_from_sonar = pose_of(mount);
    device.mount_trajectory = read_trajectory_name(mount, scenario.file, problems);
    device.mount_input = read_pose_endpoint(mount, "input", problems);
    if (const Value* swing = mount.get("swing"))
        device.mount_swing = read_swing(swing, mount.path_of("swing"), problems);
    refuse_contradictions(mount, problems);
    if (device.mount_input == standard_input && scenario.pose_input == standard_input)
        problems.add(mount.get("input")->place,
                     mount.path_of("input") +
                         ": vehicle.input already reads standard input; give the mount an "
                         "endpoint of its own");
}

}  // namespace echoloop::scenario
