// Made-up messages of ROS 1; the first byte chooses the type.
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosgraph_msgs/Clock.h>
#include <tf2_msgs/TFMessage.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/poses/ros1/messages.h"

namespace {

template <class M>
void morph(topic_tools::ShapeShifter& message) {
    message.morph(ros::message_traits::md5sum<M>(), ros::message_traits::datatype<M>(), "", "");
}

constexpr void (*types[])(topic_tools::ShapeShifter&) = {
    morph<nav_msgs::Odometry>,         morph<geometry_msgs::Pose>,
    morph<geometry_msgs::PoseStamped>, morph<geometry_msgs::PoseWithCovarianceStamped>,
    morph<tf2_msgs::TFMessage>,        morph<geometry_msgs::TransformStamped>,
    morph<rosgraph_msgs::Clock>};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;  // topic_tools copies nothing from nowhere, which is harmless but not allowed
    std::vector<std::uint8_t> bytes(data + 1, data + size);
    ros::serialization::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    topic_tools::ShapeShifter message;
    types[data[0] % std::size(types)](message);
    message.read(stream);
    echoloop::poses::read_ros1(message);
    echoloop::poses::read_ros1_clock(message);
    return 0;
}
