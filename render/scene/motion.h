// Parts of a scene that move as rigid things, and how an animation moves them. Knows no file format and no
// clock: time is an argument.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/pose.h"

namespace echoloop {

/// Axis-aligned bounds in m; empty where min is beyond max.
struct Bounds {
    std::array<float, 3> min{}, max{};
};

Bounds empty_bounds();
bool is_empty(const Bounds& bounds);
void grow(Bounds& bounds, const std::array<float, 3>& point);
/// Of a box that has been moved.
Bounds placed(const Bounds& bounds, const Pose& pose);

/// A value over time, as glTF's samplers give it: before the first key and after the last one it stays.
struct KeyTrack {
    enum class Way { linear, step, cubic };
    Way way = Way::linear;
    std::vector<float> times;                  ///< s, strictly ascending, at least one
    std::vector<std::array<float, 4>> values;  ///< one per key; cubic: in-tangent, value, out-tangent

    /// Component by component; unit quaternions (`turns`) by the shortest way, of unit length.
    std::array<double, 4> at(double seconds, bool turns) const;
};

/// What an animation does with a node, all in ENU: positions x y z, rotations as quaternions w x y z.
struct NodeAnimation {
    double duration = 0;  ///< s, of the animation that it belongs to
    std::optional<KeyTrack> translation, rotation;
    Vec3 still_translation;  ///< where there is no track
    Quat still_rotation;
    std::array<Vec3, 3>
        axes;     ///< of the parent node in the frame of the mover above, or the world; with its scale
    Vec3 origin;  ///< of the parent node there
    Quat turn;    ///< of the parent node there
};

/// A part of the scene that moves as one rigid thing; what hangs on its node moves with it.
struct SceneMover {
    std::string name{};                           ///< of its node
    Pose rest{};                                  ///< world_from_object where the file puts it
    std::uint32_t above = 0;                      ///< 1 + index of the mover that it hangs on; 0: none
    std::uint32_t first_node = 0, last_node = 0;  ///< in Scene::nodes(): trees in the object's own frame
    Bounds bounds{};                              ///< in that frame
    std::optional<NodeAnimation> animation{};
};

enum class Playback { loop, once };

/// world_from_object of every mover `seconds` after the start. Where `told` has a pose that counts, else the
/// animation, else the place in the file; what hangs on another mover goes with it.
std::vector<Pose> mover_poses(std::span<const SceneMover> movers, double seconds, Playback playback,
                              std::span<const std::optional<Pose>> told = {});

}  // namespace echoloop
