// Which triangles of a mesh lie in one plane, and which stand for a curved surface. Knows no sound.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/scene/scene.h"

namespace echoloop {

/// A face and its outline.
struct OutlinedFace {
    SceneFace face;  ///< without edges, material and mover
    std::vector<FaceEdge> edges;
};

struct MeshSurfaces {
    std::vector<std::uint32_t> flat, curved;  ///< indices: three per triangle, in the mesh's order
    /// rms over the curved part of half the angle between neighbours, in rad: the slopes that its facets add.
    double mesh_slope = 0;
    std::vector<OutlinedFace> faces;  ///< of the flat part; those of less than 1 cm^2 are left out
    std::vector<float> facet;         ///< m, of each flat triangle: the smaller side of its face
};

/// Neighbours that differ by less than half a degree and lie within a quarter of a millimetre of one plane
/// are one face. A face is curved where at least 40 % of its outline leads on, by less than 15 degrees, to
/// faces that are not much smaller: bevels along a wall's edges leave it flat. `indices` has triangles with
/// areas only; `places` is welded() of the positions.
MeshSurfaces find_surfaces(std::span<const Vec3> positions, std::span<const std::uint32_t> places,
                           std::span<const std::uint32_t> indices);

}  // namespace echoloop
