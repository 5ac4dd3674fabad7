// What messages of ROS 2 on DDS tell of poses and of time. Pure functions of what CycloneDDS has read.
#pragma once

#include <dds/dds.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/poses/common/body_pose.h"

namespace echoloop::poses {

struct DdsHeard {
    std::vector<BodyPose> bodies;  ///< one, or the edges of the tree of frames
    bool transforms = false;
    std::optional<Nanoseconds> clock;
    std::string reason;  ///< why it says nothing
};

/// One kind of message.
struct DdsType {
    std::string_view name;  ///< in DDS, as in "nav_msgs::msg::dds_::Odometry_"
    const dds_topic_descriptor_t* descriptor;
    DdsHeard (*read)(const void* sample);
};

/// Odometry, Pose, PoseStamped, PoseWithCovarianceStamped, TransformStamped, TFMessage, Clock.
std::span<const DdsType> dds_types();
/// By its name in DDS or in ROS 2 ("nav_msgs/msg/Odometry", "nav_msgs/Odometry"); nullptr: not known here.
const DdsType* find_dds_type(std::string_view name);
/// "rt/odom", as ROS 2 calls /odom in DDS.
std::string dds_topic(std::string_view ros_topic);

}  // namespace echoloop::poses
