// The outline of a flat face: its edges put together, straight pieces as one, in axes of the face. Knows no
// mesh.
#pragma once

#include <cstdint>
#include <span>

#include "render/scene/flat_faces.h"

namespace echoloop {

/// From a place to the next, wound as the face.
struct OutlineEdge {
    std::uint32_t from, to;
    Vec3 start, end;  ///< m
};

/// The face in the plane through `middle`, u along its longest straight piece. An outline of more than 256
/// pieces becomes the rectangle around it.
OutlinedFace outlined(Vec3 middle, Vec3 normal, std::span<const OutlineEdge> edges);

}  // namespace echoloop
