#include "render/scene/movers.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>

#include "render/scene/fault.h"
#include "render/scene/limits.h"
#include "render/scene/scene.h"

namespace echoloop {
namespace {

constexpr const char* export_animation = "export the animation again";

struct NodeTracks {
    double duration = 0;
    std::optional<KeyTrack> translation, rotation;
};

std::array<float, 4> enu_translation(const std::array<float, 4>& v) { return {v[0], -v[2], v[1], 0}; }
std::array<float, 4> enu_rotation(const std::array<float, 4>& q) { return {q[3], q[0], -q[2], q[1]}; }

void check_times(const std::vector<float>& times, const std::string& place) {
    for (std::size_t i = 0; i < times.size(); ++i)
        if (!(times[i] >= 0 && times[i] <= 1e6F) || (i > 0 && !(times[i] > times[i - 1])))
            scene_fault(place + ".input",
                        "has a time that is negative, beyond 1e6 s or not after the one before",
                        export_animation);
}

void check_turns(const KeyTrack& track, const std::string& place) {
    const std::size_t step = track.way == KeyTrack::Way::cubic ? 3 : 1;
    for (std::size_t i = step / 2; i < track.values.size(); i += step) {
        double square = 0;
        for (const float part : track.values[i])
            square += static_cast<double>(part) * static_cast<double>(part);
        if (!(std::abs(std::sqrt(square) - 1) < 0.05))
            scene_fault(place + ".output", "has a rotation that is not a unit quaternion", "normalise it");
    }
}

KeyTrack read_track(const GltfModel& model, const DocumentChannel& channel, std::size_t& keys) {
    KeyTrack track{channel.way, model.read_scalars(channel.input, channel.place + ".input"), {}};
    keys += track.times.size();
    if (keys > scene_limits::animation_keys)
        scene_fault("animations", "have more than " + std::to_string(scene_limits::animation_keys) + " keys",
                    "sample them more coarsely");
    check_times(track.times, channel.place);
    track.values = model.read_values(channel.output, channel.turns ? 4 : 3, channel.place + ".output");
    const std::size_t per_key = channel.way == KeyTrack::Way::cubic ? 3 : 1;
    if (track.values.size() != per_key * track.times.size())
        scene_fault(channel.place + ".output",
                    "has " + std::to_string(track.values.size()) + " values for " +
                        std::to_string(track.times.size()) + " times",
                    export_animation);
    for (auto& value : track.values) {
        if (!channel.turns &&
            !(std::abs(value[0]) < 1e6F && std::abs(value[1]) < 1e6F && std::abs(value[2]) < 1e6F))
            scene_fault(channel.place + ".output", "leads beyond 1e6 m", export_animation);
        value = channel.turns ? enu_rotation(value) : enu_translation(value);
    }
    if (channel.turns) check_turns(track, channel.place);
    return track;
}

/// By node. Of two channels that move the same thing the first counts.
std::map<std::size_t, NodeTracks> read_tracks(const SceneDocument& document, const GltfModel& model,
                                              std::vector<std::string>& notes) {
    std::vector<double> durations(1, 0);
    std::map<std::size_t, NodeTracks> tracks;
    std::map<std::size_t, std::size_t> animation_of;  // by node, of its first channel
    std::size_t keys = 0, doubled = 0;
    for (const DocumentChannel& channel : document.channels) {
        durations.resize(std::max(durations.size(), channel.animation + 1), 0);
        KeyTrack track = read_track(model, channel, keys);
        durations[channel.animation] =
            std::max(durations[channel.animation], static_cast<double>(track.times.back()));
        animation_of.emplace(channel.node, channel.animation);
        auto& place = channel.turns ? tracks[channel.node].rotation : tracks[channel.node].translation;
        if (place || animation_of[channel.node] != channel.animation)
            ++doubled;
        else
            place = std::move(track);
    }
    for (auto& [node, all] : tracks) all.duration = durations[animation_of[node]];
    if (document.channels_left_out > 0)
        notes.push_back(std::to_string(document.channels_left_out) +
                        " animation channels of scale or morph weights are not played");
    if (doubled > 0)
        notes.push_back(std::to_string(doubled) +
                        " animation channels are not played: another animation moves the same node");
    return tracks;
}

bool is_uniform(const std::array<Vec3, 3>& axes) {
    const double length = norm(axes[0]);
    for (std::size_t i = 0; i < 3; ++i)
        if (std::abs(norm(axes[i]) - length) > 1e-3 * length ||
            std::abs(dot(axes[i], axes[(i + 1) % 3])) > 1e-3 * length * length)
            return false;
    return dot(cross(axes[0], axes[1]), axes[2]) > 0;
}

class Planner {
  public:
    Planner(const GltfModel& model, const std::vector<PlacedNode>& placed) : model_(model), placed_(placed) {}

    void add(std::size_t index, const NodeTracks* tracks, std::uint32_t above) {
        const PlacedNode& node = placed_[index];
        if (plan.movers.size() == scene_limits::movers)
            scene_fault("nodes[" + std::to_string(node.node) + "]",
                        "is one of more than " + std::to_string(scene_limits::movers) + " that move",
                        "animate fewer");
        SceneMover mover;
        mover.name = node.object;
        mover.rest = {enu_from_gltf(glm::dvec3(node.world_from_node[3])), enu_from_gltf(node.rotation)};
        mover.above = above;
        mover.bounds = empty_bounds();
        if (tracks != nullptr) mover.animation = animation_of(node, *tracks, above);
        plan.movers.push_back(std::move(mover));
    }

    MoverPlan plan;

  private:
    NodeAnimation animation_of(const PlacedNode& node, const NodeTracks& tracks, std::uint32_t above) const {
        const GltfNode& local = model_.nodes()[node.node];
        const std::string place = "nodes[" + std::to_string(node.node) + "]";
        if (!local.matrix.empty())
            scene_fault(place + ".matrix", "belongs to an animated node",
                        "give it translation, rotation and scale");
        NodeAnimation out;
        out.duration = tracks.duration;
        out.translation = tracks.translation;
        out.rotation = tracks.rotation;
        const auto& t = local.translation;
        if (!t.empty()) out.still_translation = enu_from_gltf(glm::dvec3(t[0], t[1], t[2]));
        const auto& r = local.rotation;
        if (!r.empty())
            out.still_rotation = enu_from_gltf(glm::normalize(glm::dquat(r[3], r[0], r[1], r[2])));
        const Pose from_world = above == 0 ? Pose{} : inverse(plan.movers[above - 1].rest);
        const glm::dmat4 parent = node.parent ? placed_[*node.parent].world_from_node : glm::dmat4(1);
        const glm::dquat turn = node.parent ? placed_[*node.parent].rotation : glm::dquat(1, 0, 0, 0);
        const glm::dvec3 columns[3] = {glm::dvec3(parent[0]), -glm::dvec3(parent[2]), glm::dvec3(parent[1])};
        for (std::size_t i = 0; i < 3; ++i)
            out.axes[i] = rotate(from_world.orientation, enu_from_gltf(columns[i]));
        out.origin = from_world * enu_from_gltf(glm::dvec3(parent[3]));
        out.turn = from_world.orientation * enu_from_gltf(turn);
        if (out.rotation && !is_uniform(out.axes))
            scene_fault(place, "is turned by an animation below a scale that differs by axis or mirrors",
                        "apply the scale to the meshes first");
        return out;
    }

    const GltfModel& model_;
    const std::vector<PlacedNode>& placed_;
};

}  // namespace

Vec3 enu_from_gltf(glm::dvec3 p) { return {p.x, -p.z, p.y}; }
Quat enu_from_gltf(const glm::dquat& q) { return {q.w, q.x, -q.z, q.y}; }

MoverPlan plan_movers(const SceneDocument& document, const GltfModel& model,
                      const std::vector<PlacedNode>& placed, const SceneOptions& options) {
    Planner planner(model, placed);
    std::map<std::size_t, NodeTracks> tracks;
    if (options.animations) tracks = read_tracks(document, model, planner.plan.notes);
    std::vector<std::uint32_t>& of = planner.plan.of;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const std::uint32_t above = placed[i].parent ? of[*placed[i].parent] : 0;
        const auto moved = tracks.find(placed[i].node);
        const bool named = std::ranges::find(options.movable, placed[i].object) != options.movable.end();
        of.push_back(above);
        if (moved == tracks.end() && !named) continue;
        planner.add(i, moved == tracks.end() ? nullptr : &moved->second, above);
        of.back() = static_cast<std::uint32_t>(planner.plan.movers.size());
    }
    return std::move(planner.plan);
}

}  // namespace echoloop
