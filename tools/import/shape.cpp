#include "tools/import/shape.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <unordered_map>

namespace echoloop::worlds {
namespace {

/// One number for each place, so that corners that were split at seams are one again.
std::vector<std::uint32_t> places_of(const std::vector<Vec3>& positions) {
    std::vector<std::uint32_t> order(positions.size()), out(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t i) {
        return std::array{positions[i].x, positions[i].y, positions[i].z};
    };
    std::ranges::sort(order, {}, key);
    for (std::size_t i = 0; i < order.size(); ++i)
        out[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? out[order[i - 1]] : order[i];
    return out;
}

/// Every edge is passed once in each direction.
bool is_closed(const ShapeSurface& surface) {
    const auto place = places_of(surface.positions);
    std::unordered_map<std::uint64_t, int> edges;
    for (std::size_t i = 0; i < surface.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint64_t a = place[surface.indices[i + k]],
                                b = place[surface.indices[i + (k + 1) % 3]];
            if (a == b) continue;
            edges[std::min(a, b) << 32U | std::max(a, b)] += a < b ? 1 : -1;
        }
    return !edges.empty() && std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; });
}

double volume(const ShapeSurface& surface) {
    double out = 0;
    const auto corner = [&](std::size_t i) {
        return surface.positions[surface.indices[i]] - surface.positions[0];
    };
    for (std::size_t i = 0; i < surface.indices.size(); i += 3)
        out += dot(corner(i), cross(corner(i + 1), corner(i + 2))) / 6;
    return out;
}

}  // namespace

std::size_t triangles_of(const Shape& shape) {
    std::size_t out = 0;
    for (const ShapeSurface& surface : shape) out += surface.indices.size() / 3;
    return out;
}

void settle_sides(ShapeSurface& surface) {
    if (surface.double_sided || surface.indices.empty()) return;
    surface.double_sided = !is_closed(surface);
    if (surface.double_sided || volume(surface) >= 0) return;
    for (std::size_t i = 0; i < surface.indices.size(); i += 3)
        std::swap(surface.indices[i + 1], surface.indices[i + 2]);
}

}  // namespace echoloop::worlds
