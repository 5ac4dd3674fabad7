#include "tools/poses/ros1/transforms.h"

#include <tf2/exceptions.h>

namespace echoloop::poses {
namespace {

geometry_msgs::TransformStamped message(const BodyPose& edge) {
    geometry_msgs::TransformStamped made;
    made.header.frame_id = edge.parent;
    made.header.stamp.fromNSec(static_cast<std::uint64_t>(edge.stamp.value_or(0)));
    made.child_frame_id = edge.name;
    auto& t = made.transform.translation;
    auto& q = made.transform.rotation;
    t.x = edge.position[0], t.y = edge.position[1], t.z = edge.position[2];
    q.w = edge.orientation[0], q.x = edge.orientation[1], q.y = edge.orientation[2],
    q.z = edge.orientation[3];
    return made;
}

}  // namespace

bool Ros1Transforms::add(const std::vector<BodyPose>& edges, bool fixed) {
    bool taken = true;
    for (const auto& edge : edges) taken &= frames_.setTransform(message(edge), "ros", fixed);
    return taken;
}

std::optional<BodyPose> Ros1Transforms::newest(const Source& source, std::string& why) {
    try {
        const auto found = frames_.lookupTransform(world_, source.entry, ros::Time(0));
        const auto stamp = stamp_of(found.header.stamp.sec, found.header.stamp.nsec);
        const auto last = last_.find(source.entry);
        if (last != last_.end() && last->second == stamp) return {};
        last_[source.entry] = stamp;
        const auto& t = found.transform.translation;
        const auto& q = found.transform.rotation;
        return BodyPose{world_, source.entry, stamp, {t.x, t.y, t.z}, {q.w, q.x, q.y, q.z}};
    } catch (const tf2::TransformException& error) {
        why = error.what();
        return {};
    }
}

}  // namespace echoloop::poses
