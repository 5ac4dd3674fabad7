#include "render/scene/clearance.h"

#include <algorithm>
#include <cmath>

namespace echoloop {
namespace {

struct Corner {
    double x, y, z;
};

/// z of the triangle's plane below (x, y), if that is inside and the triangle faces up.
std::optional<double> height_at(double x, double y, const Corner (&t)[3]) {
    const auto cross = [](const Corner& a, const Corner& b, double px, double py) {
        return (b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x);
    };
    const double area = cross(t[0], t[1], t[2].x, t[2].y);
    if (!(area > 0)) return std::nullopt;
    double z = 0;
    for (int i = 0; i < 3; ++i) {
        const double share = cross(t[(i + 1) % 3], t[(i + 2) % 3], x, y);
        if (share < 0) return std::nullopt;
        z += share / area * t[i].z;
    }
    return z;
}

}  // namespace

std::optional<double> clearance_below(const Scene& scene, Vec3 place) {
    std::optional<double> least;
    for (const SceneChunk& chunk : scene.chunks()) {
        const Bounds& b = chunk.bounds;
        const bool above = place.x >= double(b.min[0]) && place.x <= double(b.max[0]) &&
                           place.y >= double(b.min[1]) && place.y <= double(b.max[1]) &&
                           place.z >= double(b.min[2]);
        if (chunk.mover != 0 || !above) continue;
        const auto indices = scene.indices().subspan(chunk.first_index, chunk.indices);
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            Corner corners[3];
            for (std::size_t k = 0; k < 3; ++k) {
                const auto& p = scene.vertices()[chunk.first_vertex + indices[i + k]].position;
                corners[k] = {double(p[0]), double(p[1]), double(p[2])};
            }
            const auto z = height_at(place.x, place.y, corners);
            if (z && *z <= place.z) least = std::min(least.value_or(INFINITY), place.z - *z);
        }
    }
    return least;
}

}  // namespace echoloop
