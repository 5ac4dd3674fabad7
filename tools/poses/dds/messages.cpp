#include "tools/poses/dds/messages.h"

#include <algorithm>
#include <array>

#include <ros2.h>

namespace echoloop::poses {
namespace {

constexpr std::size_t most_transforms = 10'000, longest_name = 256;

template <class Place>
std::array<double, 3> place_of(const Place& p) {
    return {p.x_, p.y_, p.z_};
}

template <class Place>
BodyPose body(const Place& place, const geometry_msgs_msg_dds__Quaternion_& q) {
    return {{}, {}, {}, place_of(place), {q.w_, q.x_, q.y_, q.z_}};
}

BodyPose body(const geometry_msgs_msg_dds__Pose_& pose) { return body(pose.position_, pose.orientation_); }

std::string text(const char* words) {
    const std::string_view all = words == nullptr ? "" : words;
    return std::string(all.substr(0, longest_name + 1));
}

std::optional<Nanoseconds> stamp(const builtin_interfaces_msg_dds__Time_& time) {
    return stamp_of(time.sec_, time.nanosec_);
}

BodyPose with_header(BodyPose body, const std_msgs_msg_dds__Header_& header, const char* child = nullptr) {
    body.parent = text(header.frame_id_);
    body.name = text(child);
    body.stamp = stamp(header.stamp_);
    return body;
}

BodyPose of_transform(const geometry_msgs_msg_dds__TransformStamped_& m) {
    return with_header(body(m.transform_.translation_, m.transform_.rotation_), m.header_, m.child_frame_id_);
}

DdsHeard one(BodyPose body) {
    DdsHeard heard;
    if (std::max(body.parent.size(), body.name.size()) > longest_name)
        heard.reason = "the name of a frame is longer than 256 bytes";
    else
        heard.bodies.push_back(std::move(body));
    return heard;
}

DdsHeard read_odometry(const void* sample) {
    const auto& m = *static_cast<const nav_msgs_msg_dds__Odometry_*>(sample);
    BodyPose pose = with_header(body(m.pose_.pose_), m.header_, m.child_frame_id_);
    pose.velocity = place_of(m.twist_.twist_.linear_);
    pose.turning = place_of(m.twist_.twist_.angular_);
    return one(std::move(pose));
}

DdsHeard read_pose(const void* sample) {
    return one(body(*static_cast<const geometry_msgs_msg_dds__Pose_*>(sample)));
}

DdsHeard read_pose_stamped(const void* sample) {
    const auto& m = *static_cast<const geometry_msgs_msg_dds__PoseStamped_*>(sample);
    return one(with_header(body(m.pose_), m.header_));
}

DdsHeard read_pose_with_covariance(const void* sample) {
    const auto& m = *static_cast<const geometry_msgs_msg_dds__PoseWithCovarianceStamped_*>(sample);
    return one(with_header(body(m.pose_.pose_), m.header_));
}

DdsHeard read_transform(const void* sample) {
    return one(of_transform(*static_cast<const geometry_msgs_msg_dds__TransformStamped_*>(sample)));
}

DdsHeard read_transforms(const void* sample) {
    const auto& list = static_cast<const tf2_msgs_msg_dds__TFMessage_*>(sample)->transforms_;
    DdsHeard heard;
    heard.transforms = true;
    if (list._length > most_transforms) {
        heard.reason = "it has more than 10000 transforms";
        return heard;
    }
    for (const auto& edge : std::span(list._buffer, list._length)) {
        DdsHeard next = one(of_transform(edge));
        heard.reason = next.reason;
        heard.bodies.insert(heard.bodies.end(), next.bodies.begin(), next.bodies.end());
    }
    return heard;
}

DdsHeard read_clock(const void* sample) {
    DdsHeard heard;
    heard.clock = stamp(static_cast<const rosgraph_msgs_msg_dds__Clock_*>(sample)->time_).value_or(0);
    return heard;
}

const std::array<DdsType, 7> types{{
    {"nav_msgs::msg::dds_::Odometry_", &nav_msgs_msg_dds__Odometry__desc, read_odometry},
    {"geometry_msgs::msg::dds_::Pose_", &geometry_msgs_msg_dds__Pose__desc, read_pose},
    {"geometry_msgs::msg::dds_::PoseStamped_", &geometry_msgs_msg_dds__PoseStamped__desc, read_pose_stamped},
    {"geometry_msgs::msg::dds_::PoseWithCovarianceStamped_",
     &geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc, read_pose_with_covariance},
    {"geometry_msgs::msg::dds_::TransformStamped_", &geometry_msgs_msg_dds__TransformStamped__desc,
     read_transform},
    {"tf2_msgs::msg::dds_::TFMessage_", &tf2_msgs_msg_dds__TFMessage__desc, read_transforms},
    {"rosgraph_msgs::msg::dds_::Clock_", &rosgraph_msgs_msg_dds__Clock__desc, read_clock},
}};

/// "nav_msgs/msg/Odometry" of "nav_msgs::msg::dds_::Odometry_"; without "msg/" if not `full`.
std::string ros_name(std::string_view name, bool full) {
    const std::string package(name.substr(0, name.find(':')));
    const auto last = name.rfind(':') + 1;
    return package + (full ? "/msg/" : "/") + std::string(name.substr(last, name.size() - last - 1));
}

}  // namespace

std::span<const DdsType> dds_types() { return types; }

const DdsType* find_dds_type(std::string_view name) {
    for (const DdsType& type : types)
        if (type.name == name || ros_name(type.name, true) == name || ros_name(type.name, false) == name)
            return &type;
    return nullptr;
}

std::string dds_topic(std::string_view ros_topic) {
    return std::string("rt") + (ros_topic.starts_with('/') ? "" : "/") + std::string(ros_topic);
}

}  // namespace echoloop::poses
