#include "render/scene/chunks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace echoloop {
namespace {

using Point = std::array<double, 3>;
using Triangles = std::span<std::uint32_t>;

std::vector<Point> centroids(std::span<const Vec3> positions, std::span<const std::uint32_t> indices) {
    std::vector<Point> out(indices.size() / 3);
    for (std::size_t t = 0; t < out.size(); ++t) {
        const Vec3 sum =
            positions[indices[3 * t]] + positions[indices[3 * t + 1]] + positions[indices[3 * t + 2]];
        out[t] = {sum.x / 3, sum.y / 3, sum.z / 3};
    }
    return out;
}

std::size_t longest_axis(Triangles triangles, const std::vector<Point>& centres) {
    constexpr double far = std::numeric_limits<double>::infinity();
    Point low{far, far, far}, high{-far, -far, -far};
    for (const std::uint32_t t : triangles)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], centres[t][axis]);
            high[axis] = std::max(high[axis], centres[t][axis]);
        }
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
        if (high[axis] - low[axis] > high[longest] - low[longest]) longest = axis;
    return longest;
}

void halve(Triangles triangles, const std::vector<Point>& centres,
           std::vector<std::vector<std::uint32_t>>& out) {
    if (triangles.size() <= chunk_triangles) {
        std::sort(triangles.begin(), triangles.end());  // the order of the file, whatever nth_element did
        out.emplace_back(triangles.begin(), triangles.end());
        return;
    }
    const std::size_t axis = longest_axis(triangles, centres), half = triangles.size() / 2;
    std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half),
                     triangles.end(), [&](std::uint32_t a, std::uint32_t b) {
                         return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis]
                                                                     : a < b;
                     });
    halve(triangles.first(half), centres, out);
    halve(triangles.subspan(half), centres, out);
}

}  // namespace

std::vector<std::vector<std::uint32_t>> cut_into_chunks(std::span<const Vec3> positions,
                                                        std::span<const std::uint32_t> indices) {
    const auto centres = centroids(positions, indices);
    std::vector<std::uint32_t> triangles(centres.size());
    std::iota(triangles.begin(), triangles.end(), 0U);
    std::vector<std::vector<std::uint32_t>> out;
    halve(triangles, centres, out);
    return out;
}

}  // namespace echoloop
