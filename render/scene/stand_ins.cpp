#include "render/scene/stand_ins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "render/scene/clusters.h"
#include "render/scene/corner_normal.h"

namespace echoloop {
namespace {

/// Cells so large that the surface of a node falls into about half as many as a chunk has triangles, or a few
/// of a small node's own; a scene's extent in the smallest fits an int.
int exponent_for(double area, std::size_t triangles) {
    constexpr double smallest = -12, largest = 17;
    const double cells = std::min(0.4 * chunk_triangles, 0.1 * static_cast<double>(triangles));
    return static_cast<int>(std::lround(std::clamp(0.5 * std::log2(area / cells), smallest, largest)));
}

/// The nodes above chunks, by the size of their cells, the finest first.
std::map<int, std::vector<std::uint32_t>> nodes_by_exponent(const Mesh& mesh,
                                                            std::span<const std::uint32_t> indices,
                                                            const ChunkTree& tree) {
    std::vector<double> area_before{0};  // of the triangles in the tree's order
    for (const std::uint32_t t : tree.triangles)
        area_before.push_back(area_before.back() +
                              norm(doubled_area(mesh, &indices[std::size_t{3} * t])) / 2);
    std::map<int, std::vector<std::uint32_t>> out;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        if (tree.is_chunk(i)) continue;
        const ChunkNode& node = tree.nodes[i];
        out[exponent_for(area_before[node.first + node.count] - area_before[node.first], node.count)]
            .push_back(i);
    }
    return out;
}

std::array<float, 3> floats(Vec3 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// The triangles of a mesh that are left after merging, and which of them meet at a place.
class MergedTriangles {
  public:
    using Corners = std::array<std::uint32_t, 3>;

    /// `order` is that of the tree.
    MergedTriangles(const Clusters& clusters, std::span<const std::uint32_t> order) : clusters_(clusters) {
        for (const std::uint32_t t : order) {
            first_of_.push_back(static_cast<std::uint32_t>(corners_.size()));
            const std::size_t i = std::size_t{3} * t;
            const Corners corners{clusters.vertex_of(i), clusters.vertex_of(i + 1),
                                  clusters.vertex_of(i + 2)};
            const auto place = [&](std::size_t k) { return clusters.place_of(corners[k]); };
            if (place(0) != place(1) && place(1) != place(2) && place(2) != place(0))
                corners_.push_back(corners);
        }
        first_of_.push_back(static_cast<std::uint32_t>(corners_.size()));
        list_by_place();
    }

    std::size_t size() const { return corners_.size(); }
    const Corners& operator[](std::uint32_t i) const { return corners_[i]; }
    /// First and last + 1 of those that come from a node's triangles.
    std::pair<std::uint32_t, std::uint32_t> of(const ChunkNode& node) const {
        return {first_of_[node.first], first_of_[node.first + node.count]};
    }
    std::span<const std::uint32_t> around(std::uint32_t vertex) const {
        const std::uint32_t place = clusters_.place_of(vertex);
        return std::span(at_place_).subspan(first_at_[place], first_at_[place + 1] - first_at_[place]);
    }

  private:
    void list_by_place() {
        first_at_.resize(clusters_.places() + 1);
        for (const Corners& corners : corners_)
            for (const std::uint32_t vertex : corners) ++first_at_[clusters_.place_of(vertex) + 1];
        std::partial_sum(first_at_.begin(), first_at_.end(), first_at_.begin());
        at_place_.resize(first_at_.back());
        std::vector<std::uint32_t> next(first_at_.begin(), first_at_.end() - 1);
        for (std::uint32_t i = 0; i < corners_.size(); ++i)
            for (const std::uint32_t vertex : corners_[i]) at_place_[next[clusters_.place_of(vertex)]++] = i;
    }

    const Clusters& clusters_;
    std::vector<Corners> corners_;
    std::vector<std::uint32_t> first_of_;             ///< by position in the tree's order
    std::vector<std::uint32_t> first_at_, at_place_;  ///< triangles at_place_[first_at_[p]..first_at_[p + 1]]
};

/// Writes the stand-ins of one size of cells.
class StandInWriter {
  public:
    StandInWriter(const Clusters& clusters, const MergedTriangles& triangles,
                  std::vector<CoarseVertex>& vertices, std::vector<std::uint16_t>& indices)
        : clusters_(clusters),
          triangles_(triangles),
          vertices_(vertices),
          indices_(indices),
          local_(clusters.vertices()),
          written_(triangles.size()) {}

    /// Also takes the triangles around those of the node, so that no gap is seen to a neighbour that is drawn
    /// in another size: merging moves the border between them by up to half a cell.
    void write(const ChunkNode& chunks, SceneNode& node) {
        first_vertex_ = vertices_.size();
        const std::size_t first_index = indices_.size();
        ++node_;
        error_ = 0;
        const auto [first, last] = triangles_.of(chunks);
        for (std::uint32_t i = first; i < last; ++i) triangle(i);
        for (std::uint32_t i = first; i < last; ++i)
            for (const std::uint32_t vertex : triangles_[i])
                for (const std::uint32_t neighbour : triangles_.around(vertex)) triangle(neighbour);
        for (const std::uint32_t vertex : touched_) local_[vertex] = 0;
        touched_.clear();
        const std::size_t used = vertices_.size() - first_vertex_, count = indices_.size() - first_index;
        if (count == 0 || 2 * count > std::size_t{3} * chunks.count ||
            used > std::numeric_limits<std::uint16_t>::max()) {
            vertices_.resize(first_vertex_);
            indices_.resize(first_index);
            return;
        }
        node.coarse = true;
        node.first_vertex = static_cast<std::uint32_t>(first_vertex_);
        node.vertices = static_cast<std::uint32_t>(used);
        node.first_index = static_cast<std::uint32_t>(first_index);
        node.indices = static_cast<std::uint32_t>(count);
        node.error = static_cast<float>(error_);
    }

  private:
    void triangle(std::uint32_t i) {
        if (written_[i] == node_) return;
        written_[i] = node_;
        for (const std::uint32_t vertex : triangles_[i]) indices_.push_back(local(vertex));
    }

    std::uint16_t local(std::uint32_t vertex) {
        if (local_[vertex] == 0) {
            touched_.push_back(vertex);
            vertices_.push_back({{floats(clusters_.position(vertex)), floats(clusters_.normal(vertex))},
                                 clusters_.roughness(vertex)});
            local_[vertex] = static_cast<std::uint32_t>(vertices_.size() - first_vertex_);
            error_ = std::max(error_, clusters_.error(vertex));
        }
        return static_cast<std::uint16_t>(local_[vertex] - 1);
    }

    const Clusters& clusters_;
    const MergedTriangles& triangles_;
    std::vector<CoarseVertex>& vertices_;
    std::vector<std::uint16_t>& indices_;
    std::vector<std::uint32_t> local_, touched_;  ///< 1 + number within the node, or 0
    std::vector<std::uint32_t> written_;          ///< the node that had a triangle last
    std::uint32_t node_ = 0;
    std::size_t first_vertex_ = 0;
    double error_ = 0;
};

}  // namespace

void add_stand_ins(const Mesh& mesh, std::span<const std::uint32_t> mesh_indices, const ChunkTree& tree,
                   std::span<SceneNode> nodes, std::vector<CoarseVertex>& vertices,
                   std::vector<std::uint16_t>& indices) {
    std::optional<Clusters> clusters;
    for (const auto& [exponent, members] : nodes_by_exponent(mesh, mesh_indices, tree)) {
        if (clusters) {
            Clusters coarser(std::move(*clusters), exponent);
            clusters.emplace(std::move(coarser));
        } else {
            clusters.emplace(mesh, mesh_indices, exponent);
        }
        const MergedTriangles merged(*clusters, tree.triangles);
        StandInWriter writer(*clusters, merged, vertices, indices);
        for (const std::uint32_t i : members) writer.write(tree.nodes[i], nodes[i]);
    }
}

}  // namespace echoloop
