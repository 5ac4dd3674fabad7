// Makes the coarse stand-ins of a mesh's nodes: about as many triangles for each node as a chunk has.
// Deterministic.
#pragma once

#include <span>
#include <vector>

#include "render/scene/chunks.h"
#include "render/scene/scene.h"

namespace echoloop {

/// Appends to `vertices` and `indices`, and fills in those of `nodes` (one per node of the tree) for which a
/// stand-in has at most half of the triangles.
void add_stand_ins(const Mesh& mesh, std::span<const std::uint32_t> mesh_indices, const ChunkTree& tree,
                   std::span<SceneNode> nodes, std::vector<CoarseVertex>& vertices,
                   std::vector<std::uint16_t>& indices);

}  // namespace echoloop
