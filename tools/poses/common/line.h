// The line of JSON by which the emulator learns a pose or that time has passed. Pure functions of numbers.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "render/pose.h"
#include "tools/poses/common/body_pose.h"

namespace echoloop::poses {

/// "12.5": exact, in seconds.
std::string seconds_text(Nanoseconds time);

/// m/s in the world, and rad/s about the body's axes.
struct Rates {
    std::optional<Vec3> velocity, turning;
};

/// One line without its end. `key`: what the time is called, "t" or "now". `object`: a node of the scene;
/// empty: the vehicle. Numbers keep every bit; rates that the emulator would refuse are left out.
std::string pose_line(const Pose& world_from_body, const std::string& object, const std::string& key,
                      std::optional<Nanoseconds> time, const Rates& rates = {});

/// The same of a fix: a place on the Earth and no attitude.
std::string fix_line(const std::array<double, 3>& fix, const std::string& object, const std::string& key,
                     std::optional<Nanoseconds> time);

/// {"now": 12.5}
std::string step_line(Nanoseconds now);

/// Why the emulator would refuse the pose; empty if it would not.
std::string fault_of(const Pose& pose);
std::string fault_of_fix(const std::array<double, 3>& fix);

}  // namespace echoloop::poses
