// The node tree of a glTF document, flattened: each mesh that is used, with its transform to the world.
// Refuses cycles, shared children and transforms that are not finite or have no volume.
#pragma once

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <string>
#include <vector>

#include "render/scene/gltf_model.h"

namespace echoloop {

struct PlacedMesh {
    std::size_t node, mesh;
    std::string object;          ///< the node's name, or "node<index>"
    glm::dmat4 world_from_mesh;  ///< still glTF axes, y up
};

/// In the order of a depth-first walk. Throws SceneFault.
std::vector<PlacedMesh> flatten_nodes(const GltfModel& model);

}  // namespace echoloop
