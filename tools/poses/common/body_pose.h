// What a message of any middleware tells of one body, before anybody knows whose pose it is, and where the
// poses that a user wants come from. Knows no middleware; C++17, as ROS 1 has it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace echoloop::poses {

using Nanoseconds = std::int64_t;

struct BodyPose {
    std::string parent;                             ///< frame that the pose is in; empty: not told
    std::string name;                               ///< of the body or its frame; empty: not told
    std::optional<Nanoseconds> stamp;               ///< empty: not told, or zero
    std::array<double, 3> position{};               ///< m, x y z in the parent
    std::array<double, 4> orientation{1, 0, 0, 0};  ///< parent_from_body, w x y z
    /// m/s and rad/s, both in the axes of the body (a twist in its child frame); empty: not told
    std::optional<std::array<double, 3>> velocity{}, turning{};
    /// Latitude and longitude in degrees and altitude in m, in place of position and orientation; of a
    /// satellite receiver.
    std::optional<std::array<double, 3>> fix{};
};

/// Where the pose of one body comes from.
struct Source {
    std::string topic;
    std::string entry;   ///< which of a message's many poses; empty: its only one
    std::string object;  ///< node of the scene that moves; empty: the vehicle
};

/// Of seconds and nanoseconds as stamps have them; empty if both are zero, which is how a publisher says that
/// it has not filled them in, or if they are no time of this world.
inline std::optional<Nanoseconds> stamp_of(std::int64_t seconds, std::int64_t nanoseconds) {
    constexpr std::int64_t second = 1'000'000'000, longest = 9'000'000'000;
    if (seconds < 0 || seconds > longest || nanoseconds < 0 || nanoseconds >= second) return {};
    if (seconds == 0 && nanoseconds == 0) return {};
    return seconds * second + nanoseconds;
}

}  // namespace echoloop::poses
