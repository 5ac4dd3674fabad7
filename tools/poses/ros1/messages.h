// ROS 1 messages of any of the types that tell poses, as bodies. Opens nothing; bytes from outside are never
// trusted. C++17: the headers of ROS 1 know no later one.
#pragma once

#include <topic_tools/shape_shifter.h>
#include <optional>
#include <string>
#include <vector>

#include "tools/poses/common/body_pose.h"

namespace echoloop::poses {

struct Ros1Poses {
    std::vector<BodyPose> bodies;
    bool transforms = false;  ///< edges of the tree of frames, of which the body's pose is to be made
    std::string reason;       ///< why there are none
};

/// nav_msgs/Odometry, geometry_msgs/Pose, PoseStamped, PoseWithCovarianceStamped, TransformStamped,
/// tf2_msgs/TFMessage, tf/tfMessage, sensor_msgs/NavSatFix.
Ros1Poses read_ros1(const topic_tools::ShapeShifter& message);

/// Of a rosgraph_msgs/Clock.
std::optional<Nanoseconds> read_ros1_clock(const topic_tools::ShapeShifter& message);

}  // namespace echoloop::poses
