// Chunks are groups of triangles that lie close together, whatever else is in their mesh.
#include "render/scene/chunks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/render/meshes.h"

namespace echoloop {
namespace {

/// Walls of 60 m x 9 m in two triangles each among 80,000 of a seabed: a chunk is as large as its own
/// triangles.
TEST(Chunks, OfASeabedAreNotAsLargeAsTheWallsInTheSameMesh) {
    Mesh mesh = test::seabed(200);
    const std::size_t small = mesh.indices.size() / 3;
    for (const double x : {-30.0, 30.0}) {
        const Mesh wall = test::wall_at(x, 30, -6, 3);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), wall.positions.begin(), wall.positions.end());
        for (const std::uint32_t corner : wall.indices) mesh.indices.push_back(first + corner);
    }
    const ChunkTree tree = cut_into_chunks(mesh.positions, mesh.indices);
    std::size_t with_walls = 0;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        if (!tree.is_chunk(i)) continue;
        const auto triangles = std::span(tree.triangles).subspan(tree.nodes[i].first, tree.nodes[i].count);
        double low = 1e9, high = -1e9;  // along y, in which the walls are long
        for (const std::uint32_t t : triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const double y = mesh.positions[mesh.indices[3 * t + k]].y;
                low = std::min(low, y), high = std::max(high, y);
            }
        const bool has_wall = std::ranges::any_of(triangles, [&](std::uint32_t t) { return t >= small; });
        with_walls += has_wall ? 1 : 0;
        EXPECT_LT(high - low, has_wall ? 1e9 : 15) << "chunk " << i;
        EXPECT_LE(triangles.size(), has_wall ? 4U : chunk_triangles)
            << "chunk " << i << " has a part of the seabed, too";
    }
    EXPECT_GE(with_walls, 1U);
}

TEST(Chunks, HoldEachTriangleOnceAndAreNotTooLarge) {
    const Mesh mesh = test::seabed(100);
    const ChunkTree tree = cut_into_chunks(mesh.positions, mesh.indices);
    auto all = tree.triangles;
    std::ranges::sort(all);
    std::vector<std::uint32_t> expected(mesh.indices.size() / 3);
    std::iota(expected.begin(), expected.end(), 0U);
    EXPECT_EQ(all, expected);
    for (std::size_t i = 0; i < tree.nodes.size(); ++i)
        EXPECT_LE(tree.is_chunk(i) ? tree.nodes[i].count : 0, chunk_triangles);
}

}  // namespace
}  // namespace echoloop
