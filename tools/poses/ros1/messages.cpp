#include "tools/poses/ros1/messages.h"

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/NavSatFix.h>
#include <tf2_msgs/TFMessage.h>

#include <array>
#include <cstring>
#include <exception>

namespace echoloop::poses {
namespace {

using topic_tools::ShapeShifter;

template <class Place>
BodyPose body(const Place& place, const geometry_msgs::Quaternion& q) {
    return {{}, {}, {}, {place.x, place.y, place.z}, {q.w, q.x, q.y, q.z}};
}

BodyPose body(const std_msgs::Header& header, BodyPose pose, const std::string& name = "") {
    pose.parent = header.frame_id;
    pose.name = name;
    pose.stamp = stamp_of(header.stamp.sec, header.stamp.nsec);
    return pose;
}

BodyPose body(const geometry_msgs::Pose& p) { return body(p.position, p.orientation); }
BodyPose body(const geometry_msgs::TransformStamped& t) {
    return body(t.header, body(t.transform.translation, t.transform.rotation), t.child_frame_id);
}

std::vector<BodyPose> bodies(const geometry_msgs::Pose& m) { return {body(m)}; }
std::vector<BodyPose> bodies(const geometry_msgs::PoseStamped& m) { return {body(m.header, body(m.pose))}; }
std::vector<BodyPose> bodies(const geometry_msgs::PoseWithCovarianceStamped& m) {
    return {body(m.header, body(m.pose.pose))};
}
std::vector<BodyPose> bodies(const nav_msgs::Odometry& m) {
    BodyPose told = body(m.header, body(m.pose.pose), m.child_frame_id);
    const auto &v = m.twist.twist.linear, &w = m.twist.twist.angular;
    told.velocity = {v.x, v.y, v.z}, told.turning = {w.x, w.y, w.z};
    return {told};
}
std::vector<BodyPose> bodies(const geometry_msgs::TransformStamped& m) { return {body(m)}; }
std::vector<BodyPose> bodies(const sensor_msgs::NavSatFix& m) {
    if (m.status.status < 0) throw std::runtime_error("its receiver has no fix");
    BodyPose told = body(m.header, BodyPose());
    told.fix = {m.latitude, m.longitude, m.altitude};
    return {told};
}
std::vector<BodyPose> bodies(const tf2_msgs::TFMessage& m) {
    std::vector<BodyPose> all;
    all.reserve(m.transforms.size());
    for (const auto& edge : m.transforms) all.push_back(body(edge));
    return all;
}

template <class M>
std::vector<BodyPose> read(const ShapeShifter& message) {
    return bodies(*message.instantiate<M>());
}

/// roscpp makes room for as many transforms as the message claims to hold before it reads them.
bool lies_about_its_size(const ShapeShifter& message) {
    constexpr std::uint32_t smallest =
        4 + 8 + 4 + 4 + 7 * 8;  // sequence, stamp, two empty names, seven numbers
    if (message.size() < 4) return true;
    std::vector<std::uint8_t> bytes(message.size());
    ros::serialization::OStream stream(bytes.data(), message.size());
    message.write(stream);
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data(), sizeof count);  // little-endian, as ROS 1 writes it
    return count > message.size() / smallest;
}

std::vector<BodyPose> read_transforms(const ShapeShifter& message) {
    if (lies_about_its_size(message)) throw std::runtime_error("it holds fewer transforms than it says");
    // The type's first name was tf/tfMessage, with the same bytes.
    ShapeShifter renamed = message;
    renamed.morph(ros::message_traits::md5sum<tf2_msgs::TFMessage>(),
                  ros::message_traits::datatype<tf2_msgs::TFMessage>(), "", "");
    return read<tf2_msgs::TFMessage>(renamed);
}

struct Type {
    const char* name;
    std::vector<BodyPose> (*read)(const ShapeShifter&);
    bool transforms;
};

constexpr std::array<Type, 8> types{{
    {"nav_msgs/Odometry", read<nav_msgs::Odometry>, false},
    {"geometry_msgs/PoseStamped", read<geometry_msgs::PoseStamped>, false},
    {"geometry_msgs/PoseWithCovarianceStamped", read<geometry_msgs::PoseWithCovarianceStamped>, false},
    {"geometry_msgs/TransformStamped", read<geometry_msgs::TransformStamped>, false},
    {"geometry_msgs/Pose", read<geometry_msgs::Pose>, false},
    {"sensor_msgs/NavSatFix", read<sensor_msgs::NavSatFix>, false},
    {"tf2_msgs/TFMessage", read_transforms, true},
    {"tf/tfMessage", read_transforms, true},
}};

}  // namespace

Ros1Poses read_ros1(const ShapeShifter& message) {
    std::string known;
    for (const auto& type : types) {
        known += (known.empty() ? "" : ", ") + std::string(type.name);
        if (message.getDataType() != type.name) continue;
        try {
            return {type.read(message), type.transforms, ""};
        } catch (const std::exception& error) {
            return {{}, false, std::string(type.name) + " that cannot be read: " + error.what()};
        }
    }
    return {{},
            false,
            "its type " + message.getDataType() + " tells no pose that is known here; known are " + known};
}

std::optional<Nanoseconds> read_ros1_clock(const ShapeShifter& message) {
    try {
        const auto clock = message.instantiate<rosgraph_msgs::Clock>()->clock;
        return static_cast<Nanoseconds>(clock.toNSec());
    } catch (const std::exception&) {
        return {};
    }
}

}  // namespace echoloop::poses
