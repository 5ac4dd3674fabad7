// The normal of a triangle's corner: the mesh's own where it is of use, else the triangle's.
#pragma once

#include <array>
#include <cmath>

#include "render/scene/scene.h"

namespace echoloop {

inline std::array<float, 3> floats(Vec3 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Twice the area along the normal, by the winding. `corner` has three vertex numbers.
inline Vec3 doubled_area(const Mesh& mesh, const std::uint32_t* corner) {
    const Vec3 a = mesh.positions[corner[0]];
    return cross(mesh.positions[corner[1]] - a, mesh.positions[corner[2]] - a);
}

/// Unit, or zero for a triangle without area.
inline Vec3 face_normal(const Mesh& mesh, const std::uint32_t* corner) {
    const Vec3 n = doubled_area(mesh, corner);
    const double length = norm(n);
    return length > 0 ? (1 / length) * n : Vec3{};
}

struct CornerNormal {
    Vec3 normal;          ///< unit
    bool smooth = false;  ///< it is the vertex's own, not the triangle's
};

inline CornerNormal corner_normal(const Mesh& mesh, std::uint32_t vertex, Vec3 face) {
    const Vec3 given = mesh.normals.empty() ? Vec3{} : mesh.normals[vertex];
    const double length = norm(given);
    if (length > 1e-6 && std::isfinite(length) && dot(given, face) > 0) return {(1 / length) * given, true};
    return {face, false};
}

}  // namespace echoloop
