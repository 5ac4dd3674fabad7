// What rosbridge says (protocol version 2, JSON) of poses and of time, in the words of ROS 1 and of ROS 2.
// Pure functions of hostile text.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/poses/common/body_pose.h"

namespace echoloop::poses {

struct RosbridgeHeard {
    std::string topic;             ///< empty: it says nothing of a topic
    std::vector<BodyPose> bodies;  ///< one, or the edges of the tree of frames
    bool transforms = false;
    std::optional<Nanoseconds> clock;
    std::string reason;  ///< why it says nothing
};

/// A "publish" whose message has the shape of nav_msgs Odometry, geometry_msgs Pose, PoseStamped,
/// PoseWithCovarianceStamped, TransformStamped, tf2_msgs TFMessage or rosgraph_msgs Clock; or a "status" that
/// complains.
RosbridgeHeard read_rosbridge(std::string_view text);

/// The request for a topic. `type`: may be empty, if the topic has a publisher.
std::string subscribe_request(const std::string& topic, const std::string& type);

/// What makes the topic of the answers known, and an answer: a rosgraph_msgs/Clock, as both generations take
/// it.
std::string advertise_request(const std::string& topic);
std::string clock_message(const std::string& topic, Nanoseconds time);

}  // namespace echoloop::poses
