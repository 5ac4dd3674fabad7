// Cuts triangles into spatially compact groups, and those into a tree, by halving at the median along the
// longest axis. Deterministic; knows no level of detail.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/pose.h"

namespace echoloop {

inline constexpr std::size_t chunk_triangles = 256;

/// One group of triangles: a chunk, or all chunks of the nodes below.
struct ChunkNode {
    std::uint32_t first = 0, count = 0;  ///< in ChunkTree::triangles
    std::uint32_t next = 0;              ///< index of the first node that is not below this one
};

struct ChunkTree {
    std::vector<std::uint32_t> triangles;  ///< every triangle number once; ascending within a chunk
    std::vector<ChunkNode> nodes;          ///< parents before their children; the root first

    bool is_chunk(std::size_t node) const { return nodes[node].next == node + 1; }
};

/// Chunks have at most chunk_triangles triangles; those of a larger mesh hold a quarter as many or more, but
/// for those of its few largest triangles. Triangle t has the corners positions[indices[3 t + 0..2]].
ChunkTree cut_into_chunks(std::span<const Vec3> positions, std::span<const std::uint32_t> indices);

}  // namespace echoloop
