#include "render/scene/builder.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <limits>
#include <numbers>
#include <utility>

#include "render/scene/chunk_writer.h"
#include "render/scene/corner_normal.h"
#include "render/scene/fault.h"
#include "render/scene/forget.h"
#include "render/scene/limits.h"
#include "render/scene/mesh_loops.h"
#include "render/scene/stand_ins.h"
#include "render/scene/welding.h"

namespace echoloop {
namespace {

bool within_extent(Vec3 p) {
    constexpr double most = scene_limits::extent;
    return std::abs(p.x) <= most && std::abs(p.y) <= most && std::abs(p.z) <= most;  // false for NaN
}

void check_mesh(const Mesh& mesh, const std::string& place) {
    MeshLoops loops(mesh.positions.size());
    const auto is_far = [&](std::size_t i) { return !within_extent(mesh.positions[i]); };
    const bool far = loops.any(mesh.positions.size(), is_far);
    for (std::size_t i = 0; far && i < mesh.positions.size(); ++i)
        if (is_far(i))
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
    const auto is_beyond = [&](std::uint32_t index) { return index >= mesh.positions.size(); };
    const bool beyond =
        loops.any(mesh.indices.size(), [&](std::size_t i) { return is_beyond(mesh.indices[i]); });
    for (std::size_t i = 0; beyond && i < mesh.indices.size(); ++i)
        if (const std::uint32_t index = mesh.indices[i]; is_beyond(index))
            scene_fault(place, "index " + std::to_string(index) + " is out of range", "repair the mesh");
    if (!std::isfinite(mesh.material.mu_db)) scene_fault(place, "mu_db is not finite", "give mu_db in dB");
}

/// Triangles with no area have no side and would only disturb culling.
bool is_sliver(const Mesh& mesh, std::size_t i) { return face_normal(mesh, &mesh.indices[i]) == Vec3{}; }

/// The indices without slivers: the mesh's own where it has none, else those that are put into `kept`.
std::span<const std::uint32_t> without_slivers(const Mesh& mesh, std::vector<std::uint32_t>& kept) {
    const std::size_t count = mesh.indices.size() / 3;
    if (!MeshLoops(count).any(count, [&](std::size_t i) { return is_sliver(mesh, 3 * i); }))
        return mesh.indices;
    std::size_t first = 0;
    while (!is_sliver(mesh, first)) first += 3;
    kept.reserve(mesh.indices.size());
    kept.assign(mesh.indices.data(), mesh.indices.data() + first);
    for (std::size_t i = first + 3; i < mesh.indices.size(); i += 3)
        if (!is_sliver(mesh, i)) kept.insert(kept.end(), &mesh.indices[i], &mesh.indices[i] + 3);
    return kept;
}

/// So that large meshes are not copied while they grow, and many small ones not each time.
template <typename T>
void make_room(std::vector<T>& in, std::size_t more) {
    if (in.size() + more > in.capacity()) in.reserve(std::max(in.size() + more, 2 * in.capacity()));
}

/// From now on in one piece with what comes behind it.
template <typename T>
void append(std::vector<T>& to, std::vector<T>& more) {
    if (to.capacity() - to.size() < more.size()) {
        std::vector<T> all;
        all.reserve(to.size() + more.size());
        all.insert(all.end(), to.begin(), to.end());
        to = std::move(all);
    }
    to.insert(to.end(), more.begin(), more.end());
    forget(more);
}

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

/// Its number as vertices have it. An object's surfaces follow one another.
float SceneBuilder::surface_number(std::uint32_t object, std::uint32_t material) {
    auto& all = scene_->surfaces_;
    std::size_t i = all.size();
    while (i > 0 && all[i - 1].object == object && all[i - 1].material != material) --i;
    if (i > 0 && all[i - 1].object == object) return static_cast<float>(i);
    all.push_back({object, material});
    return static_cast<float>(all.size());
}

void SceneBuilder::add(Mesh mesh, const std::string& place) {
    check_mesh(mesh, place);
    std::vector<std::uint32_t> kept;
    const auto indices = without_slivers(mesh, kept);
    if (scene_->indices_.size() / 3 + indices.size() / 3 > scene_limits::triangles)
        scene_fault(place,
                    "the scene has more than " + std::to_string(scene_limits::triangles) + " triangles",
                    "simplify its meshes");
    MeshLoops loops(mesh.positions.size());
    const auto places = welded(mesh.positions, loops);
    MeshSurfaces surfaces = find_surfaces(mesh.positions, places, indices);
    forget(kept), forget(mesh.indices);
    Material material = without_excess(mesh.material);
    if (!surfaces.flat.empty()) {
        const std::uint32_t flat = material_index(material);
        add_part(mesh, places, std::move(surfaces.flat), flat, surfaces.facet, surfaces.curved.empty());
        collect_faces(std::move(surfaces.faces), flat);
    }
    if (!surfaces.curved.empty()) {
        material.mesh_slope = std::max(1.0, std::round(100 * surfaces.mesh_slope)) / 100;
        add_part(mesh, places, std::move(surfaces.curved), material_index(material), {}, true);
    }
}

void SceneBuilder::add_part(Mesh& mesh, std::span<const std::uint32_t> places,
                            std::vector<std::uint32_t> indices, std::uint32_t material,
                            std::span<const float> facet, bool last) {
    constexpr std::size_t worth_a_thread = 20'000;  // triangles
    const SceneSurface surface{object_index(mesh.object), material};
    const float number = surface_number(surface.object, surface.material);
    const ChunkTree tree = cut_into_chunks(mesh.positions, indices);
    const std::size_t first_node = scene_->nodes_.size();
    const auto place_of = places_of(tree, first_node);
    add_nodes(tree, place_of, surface);
    auto chunks = std::async(indices.size() / 3 < worth_a_thread ? std::launch::deferred
                                                                 : std::launch::async | std::launch::deferred,
                             [&] { add_chunks(mesh, indices, facet, tree, place_of, number); });
    const auto forget_mesh = [&] {
        chunks.get();
        forget(indices);
        if (last) mesh = {};
    };
    add_stand_ins(mesh, places, indices, tree, place_of, number, scene_->nodes_, coarse_vertices_,
                  coarse_indices_, forget_mesh);
    bound(first_node);
}

void SceneBuilder::add_nodes(const ChunkTree& tree, std::span<const std::uint32_t> place_of,
                             SceneSurface surface) {
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        SceneNode node;
        node.next = place_of[tree.nodes[i].next];
        node.object = surface.object;
        node.material = surface.material;
        node.error = tree.is_chunk(i) ? 0 : std::numeric_limits<float>::infinity();
        scene_->nodes_.insert(scene_->nodes_.end(), place_of[i + 1] - place_of[i], node);
    }
}

/// Touches no node but those of chunks: stand-ins are made meanwhile.
void SceneBuilder::add_chunks(const Mesh& mesh, std::span<const std::uint32_t> indices,
                              std::span<const float> facet, const ChunkTree& tree,
                              std::span<const std::uint32_t> place_of, float surface) {
    // The stand-ins follow in the same vectors: room that nothing is written to takes no memory.
    make_room(scene_->indices_, 2 * indices.size());
    make_room(scene_->vertices_, 2 * std::min(indices.size(), mesh.positions.size() * 3 / 2));
    ChunkWriter writer(mesh, surface, scene_->vertices_, scene_->indices_);
    Bounds& bounds = scene_->movers_.empty() ? scene_->still_bounds_ : scene_->movers_.back().bounds;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        if (!tree.is_chunk(i)) continue;
        SceneNode& node = scene_->nodes_[place_of[i]];
        writer.begin();
        for (const std::uint32_t t :
             std::span(tree.triangles).subspan(tree.nodes[i].first, tree.nodes[i].count))
            writer.triangle(&indices[std::size_t{3} * t]);
        SceneChunk chunk = writer.finish();
        chunk.object = node.object;
        chunk.material = node.material;
        chunk.mover = mover();
        if (!facet.empty()) chunk.facet = median_of(facet, tree, tree.nodes[i]);
        scene_->chunks_.push_back(chunk);
        enclose(bounds, chunk.bounds);
        node.bounds = chunk.bounds;
        node.first_vertex = chunk.first_vertex;
        node.vertices = chunk.vertices;
        node.first_index = chunk.first_index;
        node.indices = chunk.indices;
    }
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
    scene_->fine_vertices_ = scene_->vertices_.size();
    scene_->fine_indices_ = scene_->indices_.size();
    append(scene_->vertices_, coarse_vertices_);
    append(scene_->indices_, coarse_indices_);
    scene_->nodes_.shrink_to_fit();
    scene_->bounds_ = scene_->still_bounds_;
    for (const SceneMover& mover : scene_->movers_)
        enclose(scene_->bounds_, placed(mover.bounds, mover.rest));
    return std::shared_ptr<const Scene>(scene_.release());
}

}  // namespace echoloop
