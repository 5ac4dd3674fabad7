#include "render/scene/chunks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

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

/// m, the longest side of each triangle's box.
std::vector<float> extents(std::span<const Vec3> positions, std::span<const std::uint32_t> indices) {
    std::vector<float> out(indices.size() / 3);
    for (std::size_t t = 0; t < out.size(); ++t) {
        const Vec3 &a = positions[indices[3 * t]], &b = positions[indices[3 * t + 1]],
                   &c = positions[indices[3 * t + 2]];
        const auto side = [](double u, double v, double w) {
            return std::max({u, v, w}) - std::min({u, v, w});
        };
        out[t] =
            static_cast<float>(std::max({side(a.x, b.x, c.x), side(a.y, b.y, c.y), side(a.z, b.z, c.z)}));
    }
    return out;
}

struct Axis {
    std::size_t index = 0;
    double length = 0;  ///< m
};

Axis longest_axis(Triangles triangles, const std::vector<Point>& centres) {
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
    return {longest, high[longest] - low[longest]};
}

class TreeMaker {
  public:
    TreeMaker(ChunkTree& tree, const std::vector<Point>& centres, const std::vector<float>& extents)
        : tree_(tree), centres_(centres), extents_(extents) {}

    void add_node(std::size_t first, std::size_t count) {
        const std::size_t node = tree_.nodes.size();
        tree_.nodes.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count), 0});
        const auto begin = tree_.triangles.begin() + static_cast<std::ptrdiff_t>(first);
        if (count <= chunk_triangles)
            std::sort(begin, begin + static_cast<std::ptrdiff_t>(count));  // the file's order
        else
            add_children(first, count);
        tree_.nodes[node].next = static_cast<std::uint32_t>(tree_.nodes.size());
    }

  private:
    void add_children(std::size_t first, std::size_t count) {
        const std::size_t large = large_ones(first, count);
        if (large > 0) {
            add_node(first, large);
            add_node(first + large, count - large);
            return;
        }
        const std::size_t half = split(first, count);
        for (const auto& [begin, size] : {std::pair{first, half}, {first + half, count - half}}) {
            const std::size_t quarter = split(begin, size);
            add_node(begin, quarter);
            add_node(begin + quarter, size - quarter);
        }
    }

    /// Moves the few triangles that are as large as half of the node or larger to the front and returns how
    /// many there are: a wall among the small triangles of a seabed would make every chunk that has a part of
    /// it as large as the wall.
    std::size_t large_ones(std::size_t first, std::size_t count) {
        const Triangles triangles = Triangles(tree_.triangles).subspan(first, count);
        const double limit = longest_axis(triangles, centres_).length / 2;
        const auto is_large = [&](std::uint32_t t) { return extents_[t] >= limit; };
        const auto large = static_cast<std::size_t>(std::ranges::count_if(triangles, is_large));
        if (large == 0 || large > count / 8) return 0;
        std::ranges::stable_partition(triangles, is_large);
        return large;
    }

    /// Moves the lower half along the longest axis to the front and returns its size.
    std::size_t split(std::size_t first, std::size_t count) {
        const Triangles triangles = Triangles(tree_.triangles).subspan(first, count);
        const std::size_t axis = longest_axis(triangles, centres_).index, half = count / 2;
        std::nth_element(
            triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half), triangles.end(),
            [&](std::uint32_t a, std::uint32_t b) {
                return centres_[a][axis] != centres_[b][axis] ? centres_[a][axis] < centres_[b][axis] : a < b;
            });
        return half;
    }

    ChunkTree& tree_;
    const std::vector<Point>& centres_;
    const std::vector<float>& extents_;
};

}  // namespace

ChunkTree cut_into_chunks(std::span<const Vec3> positions, std::span<const std::uint32_t> indices) {
    const auto centres = centroids(positions, indices);
    const auto sizes = extents(positions, indices);
    ChunkTree tree;
    tree.triangles.resize(centres.size());
    std::iota(tree.triangles.begin(), tree.triangles.end(), 0U);
    TreeMaker(tree, centres, sizes).add_node(0, centres.size());
    return tree;
}

}  // namespace echoloop
