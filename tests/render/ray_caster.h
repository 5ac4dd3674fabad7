// An independent check of the rasteriser: rays against triangles, one by one (Moeller & Trumbore 1997).
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "render/scene/scene.h"

namespace echoloop::test {

/// Distance along the unit vector `ray` to the front of triangle a b c.
inline std::optional<double> hit(Vec3 origin, Vec3 ray, Vec3 a, Vec3 b, Vec3 c) {
    const Vec3 ab = b - a, ac = c - a, p = cross(ray, ac);
    const double determinant = dot(ab, p);
    if (determinant <= 1e-14) return std::nullopt;  // parallel, or seen from behind
    const Vec3 t = origin - a;
    const double u = dot(t, p) / determinant;
    const Vec3 q = cross(t, ab);
    const double v = dot(ray, q) / determinant, distance = dot(ac, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1 || distance <= 0) return std::nullopt;
    return distance;
}

/// Nearest front face of all meshes along the ray; infinity when there is none.
inline double cast(std::span<const Mesh> meshes, Vec3 origin, Vec3 ray) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Mesh& mesh : meshes)
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
            if (const auto distance =
                    hit(origin, ray, mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                        mesh.positions[mesh.indices[i + 2]]))
                nearest = std::min(nearest, *distance);
    return nearest;
}

}  // namespace echoloop::test
