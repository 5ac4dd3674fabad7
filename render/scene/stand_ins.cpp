#include "render/scene/stand_ins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "render/scene/clusters.h"
#include "render/scene/contraction.h"
#include "render/scene/corner_normal.h"
#include "render/scene/forget.h"
#include "render/scene/scratch.h"

namespace echoloop {
namespace {

/// A mesh of more triangles is made coarser by a grid first, which is quicker, down to at most so many
/// places.
constexpr std::size_t most_contracted = 300'000, most_places = 160'000;

/// m, of the cells that merge vertices first: for large meshes the smallest, in quarters of a power of two,
/// in which few enough places are left, else those that hold one position only. A cell holds the corners of
/// many triangles that are smaller than it; a larger triangle has half a corner of its own, so walls of few
/// triangles make no seabed coarser.
double first_cell(const Mesh& mesh, std::span<const std::uint32_t> indices) {
    constexpr int smallest = -12, largest = 20;  // a scene's extent in the smallest fits an int
    if (indices.size() / 3 <= most_contracted) return std::ldexp(1.0, smallest);
    struct Amount {
        double area = 0, count = 0;
    };
    using BySize = std::array<Amount, largest - smallest + 1>;  // those that a cell is just too small for
    constexpr std::size_t size_shares = 8;
    std::array<BySize, size_shares> of_share;
    MeshLoops(indices.size() / 3).parts(size_shares, [&](std::size_t share) {
        BySize by_size;
        const Share own(share, size_shares, indices.size() / 3);
        for (std::size_t i = std::size_t{3} * own.first; i < std::size_t{3} * own.last; i += 3) {
            const double area = norm(doubled_area(mesh, &indices[i])) / 2;
            int exponent = 0;  // so that 4^exponent is just twice the area or more
            if (std::frexp(2 * area, &exponent) == 0.5) --exponent;
            exponent = (exponent + 1) >> 1;
            Amount& same =
                by_size[static_cast<std::size_t>(std::clamp(exponent, smallest, largest) - smallest)];
            same.area += area;
            same.count += 1;
        }
        of_share[share] = by_size;
    });
    Amount smaller, larger{0, static_cast<double>(indices.size() / 3)};
    for (int exponent = smallest; exponent < largest; ++exponent) {
        for (const BySize& by_size : of_share) {
            const Amount& these = by_size[static_cast<std::size_t>(exponent - smallest)];
            smaller.area += these.area;
            larger.count -= these.count;
        }
        for (const double step : {1.0, 1.25, 1.5, 1.75}) {
            const double cell = std::ldexp(step, exponent);
            if (smaller.area / (cell * cell) + larger.count / 2 <= most_places) return cell;
        }
    }
    return std::ldexp(1.0, largest);
}

/// Of a node with so many of the mesh's triangles, how many its stand-ins may have: the coarser and the
/// finer.
std::array<std::uint32_t, 2> most_triangles(std::uint32_t of_mesh) {
    constexpr std::uint32_t most = chunk_triangles * 6 / 10;
    const std::uint32_t finer = std::min(2 * most, of_mesh / 2);
    return {finer / 2, finer};
}

/// The places of every node before they were merged further.
class NodePlaces {
  public:
    /// `place_of_corner`: in the tree's order.
    NodePlaces(const ChunkTree& tree, std::span<const std::uint32_t> place_of_corner, std::size_t places) {
        std::vector<std::size_t> last_chunk(places);  // 1 + that had a place last
        for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
            if (!tree.is_chunk(i)) continue;
            const ChunkNode& chunk = tree.nodes[i];
            first_triangle_.push_back(chunk.first);
            first_.push_back(places_.size());
            for (const std::uint32_t place :
                 place_of_corner.subspan(std::size_t{3} * chunk.first, std::size_t{3} * chunk.count))
                if (std::exchange(last_chunk[place], i + 1) != i + 1) places_.push_back(place);
        }
        first_.push_back(places_.size());
    }
    /// Some of them several times.
    std::span<const std::uint32_t> of(const ChunkNode& node) const {
        const auto first = [&](std::uint32_t triangle) {
            return first_[static_cast<std::size_t>(std::ranges::lower_bound(first_triangle_, triangle) -
                                                   first_triangle_.begin())];
        };
        const std::size_t begin = first(node.first), end = first(node.first + node.count);
        return std::span(places_).subspan(begin, end - begin);
    }

  private:
    std::vector<std::uint32_t> first_triangle_;  ///< of every chunk
    std::vector<std::size_t> first_;             ///< of its places
    std::vector<std::uint32_t> places_;
};

struct StandIn {
    std::uint32_t node, place;  ///< in the tree, and in the scene's nodes
    std::uint32_t of_mesh;      ///< triangles that it stands for
    std::uint32_t most;         ///< triangles that it may have
    std::uint32_t first, last;  ///< of the triangles before the contraction, and behind the last
};

/// Writes stand-ins from the mesh as it is at some stage of its contraction, one after the other.
class StandInWriter {
  public:
    StandInWriter(const Contraction& contraction, float surface)
        : contraction_(contraction),
          surface_(surface),
          local_(contraction.vertices()),
          written_(contraction.triangles()),
          seen_(contraction.places()) {}

    /// Also takes the triangles around all places of the node, which now have been merged into into[places],
    /// so that no gap is seen to a neighbour that is drawn in another size: merging moves the border between
    /// them.
    void write(const StandIn& stand_in, std::span<const std::uint32_t> places,
               std::span<const std::uint32_t> into, SceneNode& node) {
        first_vertex_ = vertices_.size();
        const std::size_t first_index = indices_.size();
        ++node_;
        error_ = 0;
        const std::size_t most_indices = first_index + std::size_t{9} * stand_in.of_mesh / 4;
        for (std::uint32_t i = stand_in.first; i < stand_in.last; ++i) triangle(i);
        for (const std::uint32_t place : places) around(into[place], most_indices);
        for (const std::uint32_t vertex : touched_) local_[vertex] = 0;
        touched_.clear();
        const std::size_t used = vertices_.size() - first_vertex_, count = indices_.size() - first_index;
        if (count == 0 || indices_.size() > most_indices ||
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
        nodes_.push_back(&node);
    }

    /// Appends what was written since, and tells its nodes.
    void append_to(std::vector<SceneVertex>& vertices, std::vector<std::uint16_t>& indices) {
        for (SceneNode* node : nodes_) {
            node->first_vertex += static_cast<std::uint32_t>(vertices.size());
            node->first_index += static_cast<std::uint32_t>(indices.size());
        }
        vertices.insert(vertices.end(), vertices_.begin(), vertices_.end());
        indices.insert(indices.end(), indices_.begin(), indices_.end());
        forget(vertices_), forget(indices_), forget(nodes_);
    }

  private:
    /// Ends when there are more than `most_indices`: all triangles of the mesh may meet at one place.
    void around(std::uint32_t place, std::size_t most_indices) {
        if (seen_[place] == node_) return;
        seen_[place] = node_;
        for (const std::uint32_t i : contraction_.around(place)) {
            if (indices_.size() > most_indices) return;
            triangle(i);
        }
    }

    void triangle(std::uint32_t i) {
        if (!contraction_.is_left(i) || written_[i] == node_) return;
        written_[i] = node_;
        for (std::size_t k = 0; k < 3; ++k)
            indices_.push_back(local(contraction_.corners(i)[k], contraction_.vertex(i, k)));
    }

    std::uint16_t local(std::uint32_t place, std::uint32_t vertex) {
        if (local_[vertex] == 0) {
            touched_.push_back(vertex);
            const auto [normal, roughness] = contraction_.normal(vertex);
            vertices_.push_back(
                {floats(contraction_.position(place)), floats(normal), surface_ + 0.5F * roughness});
            local_[vertex] = static_cast<std::uint32_t>(vertices_.size() - first_vertex_);
            error_ = std::max(error_, contraction_.error(place));
        }
        return static_cast<std::uint16_t>(local_[vertex] - 1);
    }

    const Contraction& contraction_;
    const float surface_;
    std::vector<SceneVertex> vertices_;
    std::vector<std::uint16_t> indices_;
    std::vector<SceneNode*> nodes_;               ///< whose stand-ins these are
    std::vector<std::uint32_t> local_, touched_;  ///< 1 + number within the node, or 0
    std::vector<std::uint32_t> written_, seen_;   ///< the node that had a triangle, a place last
    std::uint32_t node_ = 0;
    std::size_t first_vertex_ = 0;
    double error_ = 0;
};

/// The stand-ins that wait until the mesh is coarse enough for them.
class Waiting {
  public:
    /// `triangles`: before the contraction.
    Waiting(const ChunkTree& tree, std::span<const std::uint32_t> place_of,
            std::span<const MergedTriangle> triangles)
        : left_before_(triangles.size() + 1) {
        const auto first_of = [&](std::uint32_t number) {
            return static_cast<std::uint32_t>(
                std::ranges::lower_bound(triangles, number, {}, &MergedTriangle::number) - triangles.begin());
        };
        for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
            if (tree.is_chunk(i)) continue;
            const ChunkNode& node = tree.nodes[i];
            const auto [coarser, finer] = most_triangles(node.count);
            const std::uint32_t first = first_of(node.first), last = first_of(node.first + node.count);
            waiting_.push_back({i, place_of[i], node.count, coarser, first, last});
            waiting_.push_back({i, place_of[i] + 1, node.count, finer, first, last});
        }
    }
    bool empty() const { return waiting_.empty(); }
    /// Those of which few enough triangles are left; they wait no longer.
    std::vector<StandIn> take(const Contraction& contraction) {
        for (std::size_t i = 0; i + 1 < left_before_.size(); ++i)
            left_before_[i + 1] = left_before_[i] + contraction.is_left(i);
        std::vector<StandIn> out;
        std::erase_if(waiting_, [&](const StandIn& one) {
            const bool few = left_before_[one.last] - left_before_[one.first] <= one.most;
            const bool same = !out.empty() && out.back().node == one.node;  // the finer would be the coarser
            if (few && !same) out.push_back(one);
            return few;
        });
        return out;
    }

  private:
    std::vector<std::uint32_t> left_before_;  ///< how many triangles before each one are left
    std::vector<StandIn> waiting_;
};

void put_in_order(const ChunkTree& tree, std::span<const std::uint32_t> indices,
                  std::span<std::uint32_t> out) {
    MeshLoops(tree.triangles.size()).each(tree.triangles.size(), [&](std::size_t i) {
        for (std::size_t k = 0; k < 3; ++k) out[3 * i + k] = indices[std::size_t{3} * tree.triangles[i] + k];
    });
}

}  // namespace

void add_stand_ins(const Mesh& mesh, std::span<const std::uint32_t> welded_places,
                   std::span<const std::uint32_t> mesh_indices, const ChunkTree& tree,
                   std::span<const std::uint32_t> place_of, float surface, std::span<SceneNode> nodes,
                   std::vector<SceneVertex>& vertices, std::vector<std::uint16_t>& indices,
                   const std::function<void()>& done_with_mesh) {
    constexpr double step = 1.4, first_limit = 1e-3;  // m
    if (tree.nodes.size() < 2) return done_with_mesh();
    std::optional<Scratch<std::uint32_t>> corners;
    std::unique_ptr<const Clusters> clusters;
    {
        Scratch<std::uint32_t> in_order(mesh_indices.size());
        put_in_order(tree, mesh_indices, in_order.all());
        corners.emplace(mesh_indices.size());
        clusters = std::make_unique<const Clusters>(mesh, welded_places, in_order.all(),
                                                    first_cell(mesh, mesh_indices), &*corners);
    }
    done_with_mesh();
    const NodePlaces places(tree, corners->all(), clusters->places());
    corners.reset();
    Contraction contraction(*clusters);
    Waiting waiting(tree, place_of, clusters->triangles());
    clusters.reset();
    MeshLoops loops(tree.triangles.size());
    std::vector<StandInWriter> writers(loops.threads(), StandInWriter(contraction, surface));
    for (double limit = first_limit; !waiting.empty();
         limit = step * std::max(limit, contraction.next_error())) {
        contraction.until(limit);
        const auto ready = waiting.take(contraction);
        if (!ready.empty()) {
            const auto into = contraction.into();
            loops.parts(writers.size(), [&](std::size_t part) {
                const Share own(part, writers.size(), ready.size());
                for (std::uint32_t i = own.first; i < own.last; ++i)
                    writers[part].write(ready[i], places.of(tree.nodes[ready[i].node]), into,
                                        nodes[ready[i].place]);
            });
            for (StandInWriter& writer : writers) writer.append_to(vertices, indices);
        }
        if (!std::isfinite(contraction.next_error())) break;
    }
}

}  // namespace echoloop
