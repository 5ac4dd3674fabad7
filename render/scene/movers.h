// Which nodes of a glTF document move by themselves, and by which animation. Reads no mesh.
#pragma once

#include <string>
#include <vector>

#include "render/scene/nodes.h"

namespace echoloop {

struct SceneOptions;

struct MoverPlan {
    std::vector<SceneMover> movers;  ///< parents before what hangs on them; nodes and bounds are empty yet
    std::vector<std::uint32_t>
        of;  ///< per placed node: 1 + index of the mover that carries it; 0: it stands still
    std::vector<std::string> notes;  ///< what of the animations is left out
};

/// `placed`: all nodes, depth first. Throws SceneFault for animations that cannot be played.
MoverPlan plan_movers(const SceneDocument& document, const GltfModel& model,
                      const std::vector<PlacedNode>& placed, const SceneOptions& options);

/// ENU from glTF's y-up.
Vec3 enu_from_gltf(glm::dvec3 p);
Quat enu_from_gltf(const glm::dquat& q);

}  // namespace echoloop
