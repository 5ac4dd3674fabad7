// Gazebo's messages that tell poses or simulated time, by their type's name of whatever generation, as
// bodies. Opens nothing; bytes from outside are never trusted.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/poses/common/body_pose.h"

namespace echoloop::poses {

struct GzPoses {
    std::vector<BodyPose> bodies;
    std::string reason;  ///< why there are none
};

/// Pose, Pose_V, Odometry and NavSat of gz.msgs or ignition.msgs, which have the same bytes.
GzPoses read_gz(std::string_view bytes, std::string_view type);

/// The bytes of an ignition.msgs.Clock.
std::string gz_clock(Nanoseconds time);

/// Of a Clock or of WorldStatistics.
std::optional<Nanoseconds> read_gz_clock(std::string_view bytes, std::string_view type);

}  // namespace echoloop::poses
