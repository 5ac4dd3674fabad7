#include "render/scene/builder.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <unordered_map>

#include "render/scene/corner_normal.h"
#include "render/scene/fault.h"
#include "render/scene/limits.h"
#include "render/scene/stand_ins.h"

namespace echoloop {
namespace {

bool within_extent(Vec3 p) {
    constexpr double most = scene_limits::extent;
    return std::abs(p.x) <= most && std::abs(p.y) <= most && std::abs(p.z) <= most;  // false for NaN
}

void check_mesh(const Mesh& mesh, const std::string& place) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (!within_extent(mesh.positions[i]))
            scene_fault(place,
                        "vertex " + std::to_string(i) + " is not finite or beyond 100 km from the origin",
                        "move the scene to its origin, or scale it to metres");
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size())
        scene_fault(place,
                    "has " + std::to_string(mesh.normals.size()) + " normals for " +
                        std::to_string(mesh.positions.size()) + " positions",
                    "export the mesh again");
    if (mesh.indices.size() % 3 != 0)
        scene_fault(place, "the number of indices is not a multiple of three",
                    "export the mesh as triangles");
    for (const std::uint32_t index : mesh.indices)
        if (index >= mesh.positions.size())
            scene_fault(place, "index " + std::to_string(index) + " is out of range", "repair the mesh");
    if (!std::isfinite(mesh.material.mu_db)) scene_fault(place, "mu_db is not finite", "give mu_db in dB");
}

/// Triangles with no area have no side and would only disturb culling.
std::vector<std::uint32_t> without_slivers(const Mesh& mesh) {
    std::vector<std::uint32_t> out;
    out.reserve(mesh.indices.size());
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        if (face_normal(mesh, &mesh.indices[i]) != Vec3{})
            out.insert(out.end(), &mesh.indices[i], &mesh.indices[i] + 3);
    return out;
}

/// The vertices and chunk-local indices of one chunk while it grows.
class ChunkWriter {
  public:
    ChunkWriter(const Mesh& mesh, std::vector<SceneVertex>& vertices, std::vector<std::uint16_t>& indices)
        : mesh_(mesh), vertices_(vertices), indices_(indices) {
        chunk_.first_vertex = static_cast<std::uint32_t>(vertices.size());
        chunk_.first_index = static_cast<std::uint32_t>(indices.size());
        chunk_.bounds = empty_bounds();
    }

    void triangle(const std::uint32_t* corners) {
        const Vec3 face = face_normal(mesh_, corners);
        for (int i = 0; i < 3; ++i) indices_.push_back(corner(corners[i], face));
    }

    SceneChunk finish() {
        chunk_.vertices = static_cast<std::uint32_t>(vertices_.size()) - chunk_.first_vertex;
        chunk_.indices = static_cast<std::uint32_t>(indices_.size()) - chunk_.first_index;
        return chunk_;
    }

  private:
    std::uint16_t corner(std::uint32_t index, Vec3 face) {
        const auto [normal, smooth] = corner_normal(mesh_, index, face);
        if (smooth)
            if (const auto known = known_.find(index); known != known_.end()) return known->second;
        const auto local = static_cast<std::uint16_t>(vertices_.size() - chunk_.first_vertex);
        vertices_.push_back({floats(mesh_.positions[index]), floats(normal)});
        grow(chunk_.bounds, vertices_.back().position);
        if (smooth) known_.emplace(index, local);
        return local;
    }

    const Mesh& mesh_;
    std::vector<SceneVertex>& vertices_;
    std::vector<std::uint16_t>& indices_;
    std::unordered_map<std::uint32_t, std::uint16_t> known_;
    SceneChunk chunk_;
};

void enclose(Bounds& bounds, const Bounds& more) {
    if (is_empty(more)) return;
    grow(bounds, more.min);
    grow(bounds, more.max);
}

}  // namespace

SceneBuilder::SceneBuilder() : scene_(new Scene) { scene_->still_bounds_ = empty_bounds(); }

void SceneBuilder::begin(const SceneMover& mover) {
    end_nodes();
    scene_->movers_.push_back(mover);
    scene_->movers_.back().first_node = static_cast<std::uint32_t>(scene_->nodes_.size());
}

void SceneBuilder::end_nodes() {
    const auto end = static_cast<std::uint32_t>(scene_->nodes_.size());
    scene_->movers_.empty() ? scene_->still_nodes_ = end : scene_->movers_.back().last_node = end;
}

std::uint32_t SceneBuilder::object_index(const std::string& name) {
    auto& all = scene_->objects_;
    if (all.empty() || all.back() != name) all.push_back(name);
    return static_cast<std::uint32_t>(all.size() - 1);
}

std::uint32_t SceneBuilder::material_index(const Material& material) {
    auto& all = scene_->materials_;
    const auto found = std::find(all.begin(), all.end(), material);
    if (found != all.end()) return static_cast<std::uint32_t>(found - all.begin());
    all.push_back(material);
    return static_cast<std::uint32_t>(all.size() - 1);
}

namespace {

/// A surface cannot mirror more than what it does not scatter: V^2 + pi mu <= 1. A measured curve says
/// nothing of what goes elsewhere.
Material without_excess(Material material) {
    if (!material.backscatter.empty()) return material;
    const double scattered = std::numbers::pi * std::pow(10, material.mu_db / 10);
    const double most = std::sqrt(std::max(0.0, 1 - scattered));
    material.reflection = std::clamp(material.reflection, -most, most);
    return material;
}

float median_of(std::span<const float> facet, const ChunkTree& tree, const ChunkNode& node) {
    std::vector<float> own;
    for (const std::uint32_t triangle : std::span(tree.triangles).subspan(node.first, node.count))
        own.push_back(facet[triangle]);
    const auto middle = own.begin() + static_cast<std::ptrdiff_t>(own.size() / 2);
    std::nth_element(own.begin(), middle, own.end());
    return *middle;
}

void widen(Bounds& bounds, float by) {
    for (std::size_t axis = 0; axis < 3; ++axis) bounds.min[axis] -= by, bounds.max[axis] += by;
}

/// Where in the scene's nodes those of a tree go, and where the next tree does: a chunk is one, others have
/// two, the coarser of both stand-ins first.
std::vector<std::uint32_t> places_of(const ChunkTree& tree, std::size_t first) {
    std::vector<std::uint32_t> out{static_cast<std::uint32_t>(first)};
    for (std::size_t i = 0; i < tree.nodes.size(); ++i)
        out.push_back(out.back() + (tree.is_chunk(i) ? 1U : 2U));
    return out;
}

}  // namespace

void SceneBuilder::add(const Mesh& mesh, const std::string& place) {
    check_mesh(mesh, place);
    const auto indices = without_slivers(mesh);
    if (scene_->triangles() + indices.size() / 3 > scene_limits::triangles)
        scene_fault(place,
                    "the scene has more than " + std::to_string(scene_limits::triangles) + " triangles",
                    "simplify its meshes");
    MeshSurfaces surfaces = find_surfaces(mesh.positions, indices);
    Material material = without_excess(mesh.material);
    if (!surfaces.flat.empty()) {
        const std::uint32_t flat = material_index(material);
        add_part(mesh, surfaces.flat, flat, surfaces.facet);
        collect_faces(std::move(surfaces.faces), flat);
    }
    if (!surfaces.curved.empty()) {
        material.mesh_slope = std::max(1.0, std::round(100 * surfaces.mesh_slope)) / 100;
        add_part(mesh, surfaces.curved, material_index(material), {});
    }
}

void SceneBuilder::add_part(const Mesh& mesh, std::span<const std::uint32_t> indices, std::uint32_t material,
                            std::span<const float> facet) {
    const std::uint32_t object = object_index(mesh.object);
    const ChunkTree tree = cut_into_chunks(mesh.positions, indices);
    const std::size_t first_node = scene_->nodes_.size();
    const auto place_of = places_of(tree, first_node);
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        SceneNode node;
        node.next = place_of[tree.nodes[i].next];
        node.object = object;
        node.material = material;
        node.error = std::numeric_limits<float>::infinity();
        if (tree.is_chunk(i)) {
            add_chunk(mesh, indices, tree, i, node);
            if (!facet.empty()) scene_->chunks_.back().facet = median_of(facet, tree, tree.nodes[i]);
        }
        scene_->nodes_.insert(scene_->nodes_.end(), place_of[i + 1] - place_of[i], node);
    }
    add_stand_ins(mesh, indices, tree, place_of, scene_->nodes_, scene_->coarse_vertices_,
                  scene_->coarse_indices_);
    bound(first_node);
}

void SceneBuilder::add_chunk(const Mesh& mesh, std::span<const std::uint32_t> indices, const ChunkTree& tree,
                             std::size_t index, SceneNode& node) {
    ChunkWriter writer(mesh, scene_->vertices_, scene_->indices_);
    for (const std::uint32_t t :
         std::span(tree.triangles).subspan(tree.nodes[index].first, tree.nodes[index].count))
        writer.triangle(&indices[std::size_t{3} * t]);
    SceneChunk chunk = writer.finish();
    chunk.object = node.object;
    chunk.material = node.material;
    chunk.mover = mover();
    scene_->chunks_.push_back(chunk);
    enclose(scene_->movers_.empty() ? scene_->still_bounds_ : scene_->movers_.back().bounds, chunk.bounds);
    node.bounds = chunk.bounds;
    node.first_vertex = chunk.first_vertex;
    node.vertices = chunk.vertices;
    node.first_index = chunk.first_index;
    node.indices = chunk.indices;
    node.error = 0;
}

/// Bounds of nodes that hold others, from the last to the first: all chunks below, and by how much the
/// stand-in is off. What of it reaches beyond them only closes gaps to neighbours.
void SceneBuilder::bound(std::size_t first_node) {
    auto& nodes = scene_->nodes_;
    for (std::size_t i = nodes.size(); i-- > first_node;) {
        SceneNode& node = nodes[i];
        if (node.next == i + 1) continue;
        node.bounds = empty_bounds();
        for (std::size_t child = i + 1; child < node.next; child = nodes[child].next)
            enclose(node.bounds, nodes[child].bounds);
        if (node.coarse) widen(node.bounds, node.error);
    }
}

void SceneBuilder::add(const PointTarget& target, const std::string& place) {
    if (!within_extent(target.position))
        scene_fault(place, "the target is not finite or beyond 100 km from the origin",
                    "move the scene to its origin, or scale it to metres");
    if (!(std::abs(target.strength_db) <= scene_limits::target_strength_db))
        scene_fault(place, "the target strength is not finite or beyond +-120 dB",
                    "give it in dB, for example -20");
    if (scene_->point_targets_.size() >= scene_limits::point_targets)
        scene_fault(
            place,
            "the scene has more than " + std::to_string(scene_limits::point_targets) + " point targets",
            "give it meshes instead");
    scene_->point_targets_.push_back(target);
    scene_->point_targets_.back().mover = mover();
}

void SceneBuilder::collect_faces(std::vector<OutlinedFace> faces, std::uint32_t material) {
    for (OutlinedFace& added : faces) {
        added.face.material = material, added.face.mover = mover();
        faces_.push_back(std::move(added));
    }
    if (faces_.size() > 16 * scene_limits::faces) keep_largest_faces();
}

void SceneBuilder::keep_largest_faces() {
    if (faces_.size() <= scene_limits::faces) return;
    std::ranges::stable_sort(faces_, std::greater{}, [](const OutlinedFace& f) { return f.face.area; });
    faces_.resize(scene_limits::faces);
}

void SceneBuilder::list_faces() {
    keep_largest_faces();
    std::ranges::stable_sort(faces_, {}, [](const OutlinedFace& f) { return f.face.mover; });
    for (const OutlinedFace& outlined : faces_) {
        SceneFace& face = scene_->faces_.emplace_back(outlined.face);
        face.first_edge = static_cast<std::uint32_t>(scene_->face_edges_.size());
        face.edges = static_cast<std::uint32_t>(outlined.edges.size());
        scene_->face_edges_.insert(scene_->face_edges_.end(), outlined.edges.begin(), outlined.edges.end());
    }
}

std::shared_ptr<const Scene> SceneBuilder::finish() {
    if (scene_->chunks_.empty())
        scene_fault("meshes", "there is no triangle in the scene",
                    "export meshes, not only empties, points or lines");
    end_nodes();
    list_faces();
    const auto trim = [](auto&... vectors) { (vectors.shrink_to_fit(), ...); };
    trim(scene_->vertices_, scene_->indices_, scene_->coarse_vertices_, scene_->coarse_indices_,
         scene_->nodes_);
    scene_->bounds_ = scene_->still_bounds_;
    for (const SceneMover& mover : scene_->movers_)
        enclose(scene_->bounds_, placed(mover.bounds, mover.rest));
    return std::shared_ptr<const Scene>(scene_.release());
}

}  // namespace echoloop
