// Makes the coarse stand-ins of a mesh's nodes: for each one with about half as many triangles as a chunk
// has, and one with twice as many. Deterministic.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "render/scene/chunks.h"
#include "render/scene/scene.h"

namespace echoloop {

/// Appends to `vertices` and `indices`, and fills in those of `nodes` for which a stand-in has at most half
/// of the triangles. `places`: welded() of the mesh's positions. `place_of`: of each node of the tree the
/// first of its two in `nodes`, the coarser one. `surface`: of all of the mesh, as vertices have it. Calls
/// `done_with_mesh` as soon as it needs neither the mesh nor its indices any more.
void add_stand_ins(const Mesh& mesh, std::span<const std::uint32_t> places,
                   std::span<const std::uint32_t> mesh_indices, const ChunkTree& tree,
                   std::span<const std::uint32_t> place_of, float surface, std::span<SceneNode> nodes,
                   std::vector<SceneVertex>& vertices, std::vector<std::uint16_t>& indices,
                   const std::function<void()>& done_with_mesh);

}  // namespace echoloop
