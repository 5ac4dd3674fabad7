#include "tools/poses/common/frames.h"

namespace echoloop::poses {
namespace {

constexpr std::size_t most_frames = 10'000;
constexpr int longest_chain = 100;

/// Names of old publishers begin with a slash.
std::string bare(const std::string& name) { return name.starts_with('/') ? name.substr(1) : name; }

Pose pose_of(const BodyPose& body) {
    const auto& [x, y, z] = body.position;
    const auto& [qw, qx, qy, qz] = body.orientation;
    return {{x, y, z}, {qw, qx, qy, qz}};
}

BodyPose body_of(const Pose& pose) {
    const auto& [p, q] = pose;
    return {{}, {}, {}, {p.x, p.y, p.z}, {q.w, q.x, q.y, q.z}};
}

}  // namespace

void Frames::add(const std::vector<BodyPose>& edges, bool fixed) {
    for (const auto& edge : edges) {
        const auto child = bare(edge.name);
        if (edges_.size() >= most_frames && !edges_.contains(child)) continue;
        edges_[child] = {bare(edge.parent), fixed ? std::nullopt : edge.stamp, pose_of(edge)};
    }
}

std::optional<BodyPose> Frames::newest(const std::string& body, std::string& why) {
    std::string frame = bare(body);
    const std::string world = bare(world_);
    Pose from_body;
    std::optional<Nanoseconds> stamp;
    for (int links = 0; frame != world; ++links) {
        const auto edge = edges_.find(frame);
        if (edge == edges_.end() || links == longest_chain) {
            why = "there is no transform from '" + world + "' to '" + frame + "' yet";
            return {};
        }
        from_body = links == 0 ? edge->second.parent_from_child : edge->second.parent_from_child * from_body;
        if (edge->second.stamp && (!stamp || *edge->second.stamp > *stamp)) stamp = edge->second.stamp;
        frame = edge->second.parent;
    }
    const auto last = last_.find(body);
    if (last != last_.end() && last->second == stamp) return {};
    last_[body] = stamp;
    BodyPose made = body_of(from_body);
    made.parent = world;
    made.name = body;
    made.stamp = stamp;
    return made;
}

}  // namespace echoloop::poses
