// The triangles of a scene that rays meet, with what they are made of. Knows no Embree.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/scene/scene.h"

namespace echoloop {

/// Triangles that are there from one side only, or from both.
struct TriangleSet {
    std::vector<std::uint32_t> corners;  ///< three per triangle, in Scene::all_vertices()
    /// Of each node: its first triangle, its material, its object.
    std::vector<std::uint32_t> first, material, object;
    std::vector<float> facet;  ///< of each node, as SceneChunk has it
    std::vector<float>
        height;  ///< m, of a stand-in: what a triangle that it stands for typically has; else 0
};

/// A node whose triangles rays meet: a chunk, or what stands in for several.
struct Taken {
    std::uint32_t node;
    std::uint32_t chunk;  ///< the first of those that it shows
};

/// Of the nodes first..last - 1 those that rays meet: chunks, or where a curved surface has stand-ins that
/// are off by `tolerance` m at most the coarsest of them. What is flat mirrors, and stays as it is.
std::vector<Taken> nodes_met(const Scene& scene, std::uint32_t first, std::uint32_t last, double tolerance);

std::size_t triangles_of(const Scene& scene, std::span<const Taken> taken);

TriangleSet collect(const Scene& scene, std::span<const Taken> taken, bool double_sided);

}  // namespace echoloop
