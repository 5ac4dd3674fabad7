#include "render/paths/triangle_set.h"

#include <algorithm>

namespace echoloop {
namespace {

double height_of(const SceneVertex& first, const SceneVertex& second, const SceneVertex& third) {
    const auto point = [](const SceneVertex& v) {
        return Vec3{double{v.position[0]}, double{v.position[1]}, double{v.position[2]}};
    };
    const Vec3 a = point(first), b = point(second), c = point(third);
    return norm(cross(b - a, c - a)) / std::max({norm(b - a), norm(c - b), norm(a - c)});
}

/// m, of the triangles of a chunk, of some of them: the median.
float typical_height(const Scene& scene, const SceneChunk& chunk) {
    constexpr std::size_t some = 15;
    const auto indices = scene.indices().subspan(chunk.first_index, chunk.indices);
    const std::size_t count = indices.size() / 3, used = std::min(count, some);
    std::vector<double> heights;
    for (std::size_t i = 0; i < used; ++i) {
        const std::size_t at = 3 * (i * count / used);
        const auto vertex = [&](std::size_t k) -> const SceneVertex& {
            return scene.vertices()[chunk.first_vertex + indices[at + k]];
        };
        heights.push_back(height_of(vertex(0), vertex(1), vertex(2)));
    }
    std::ranges::nth_element(heights, heights.begin() + static_cast<std::ptrdiff_t>(used / 2));
    return static_cast<float>(heights[used / 2]);
}

}  // namespace

std::vector<Taken> nodes_met(const Scene& scene, std::uint32_t first, std::uint32_t last, double tolerance) {
    const auto nodes = scene.nodes();
    const auto is_chunk = [&](std::uint32_t i) { return nodes[i].next == i + 1; };
    std::uint32_t chunk = 0;
    for (std::uint32_t i = 0; i < first; ++i) chunk += is_chunk(i);
    std::vector<Taken> out;
    for (std::uint32_t i = first; i < last; ++i) {
        const bool stands_in = nodes[i].coarse && double{nodes[i].error} <= tolerance &&
                               scene.materials()[nodes[i].material].mesh_slope > 0;
        if (stands_in || is_chunk(i)) out.push_back({i, chunk});
        chunk += is_chunk(i);
        for (const std::uint32_t next = nodes[i].next; stands_in && i + 1 < next;) chunk += is_chunk(++i);
    }
    return out;
}

std::size_t triangles_of(const Scene& scene, std::span<const Taken> taken) {
    std::size_t indices = 0;
    for (const Taken& one : taken) indices += scene.nodes()[one.node].indices;
    return indices / 3;
}

TriangleSet collect(const Scene& scene, std::span<const Taken> taken, bool double_sided) {
    TriangleSet set;
    for (const Taken& one : taken) {
        const SceneNode& node = scene.nodes()[one.node];
        if (scene.materials()[node.material].double_sided != double_sided) continue;
        const SceneChunk& chunk = scene.chunks()[one.chunk];
        set.first.push_back(static_cast<std::uint32_t>(set.corners.size() / 3));
        set.material.push_back(node.material);
        set.object.push_back(node.object);
        set.facet.push_back(chunk.facet);
        set.height.push_back(node.coarse ? typical_height(scene, chunk) : 0.0F);
        const std::size_t vertex = node.first_vertex + (node.coarse ? scene.vertices().size() : 0),
                          index = node.first_index + (node.coarse ? scene.indices().size() : 0);
        for (const std::uint16_t corner : scene.all_indices().subspan(index, node.indices))
            set.corners.push_back(static_cast<std::uint32_t>(vertex) + corner);
    }
    return set;
}

}  // namespace echoloop
