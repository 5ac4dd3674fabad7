// The node tree of a glTF document, flattened: each node that is used, with its transform to the world.
// Refuses cycles, shared children and transforms that are not finite or have no volume.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "render/scene/gltf_model.h"

namespace echoloop {

struct PlacedNode {
    std::size_t node;
    std::optional<std::size_t> mesh;
    std::string object;                 ///< the node's name, or "node<index>"
    glm::dmat4 world_from_node;         ///< still glTF axes, y up
    glm::dquat rotation;                ///< of world_from_node, without its scale
    std::optional<std::size_t> parent;  ///< index in the same list
};

/// In the order of a depth-first walk. Throws SceneFault.
std::vector<PlacedNode> flatten_nodes(const GltfModel& model);

}  // namespace echoloop
