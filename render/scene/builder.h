// Collects triangles into a Scene: checks them, gives them normals where they have none, and cuts them into
// compact chunks. Knows no file.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/scene/chunks.h"
#include "render/scene/flat_faces.h"
#include "render/scene/scene.h"

namespace echoloop {

class SceneBuilder {
  public:
    SceneBuilder();

    /// `place` names it in complaints. Throws SceneFault.
    void add(Mesh mesh, const std::string& place);
    /// Throws SceneFault for a place or strength that is out of range, and for one target too many.
    void add(const PointTarget& target, const std::string& place);
    /// What is added from here on belongs to `mover` and is in its frame; what stands still comes first.
    void begin(const SceneMover& mover);
    void add_name(const std::string& node) { scene_->node_names_.push_back(node); }
    void set_origin(const std::optional<GeoPlace>& origin) { scene_->origin_ = origin; }
    void add_note(const std::string& note) { scene_->notes_.push_back(note); }
    /// Throws SceneFault when there is no triangle.
    std::shared_ptr<const Scene> finish();

  private:
    std::uint32_t object_index(const std::string& name);
    std::uint32_t material_index(const Material& material);
    float surface_number(std::uint32_t object, std::uint32_t material);
    /// `places`: welded() of the mesh's positions. `facet` of every triangle, or empty where all are curved.
    /// `last`: the mesh is given up as soon as can be.
    void add_part(Mesh& mesh, std::span<const std::uint32_t> places, std::vector<std::uint32_t> indices,
                  std::uint32_t material, std::span<const float> facet, bool last);
    void add_nodes(const ChunkTree& tree, std::span<const std::uint32_t> place_of, SceneSurface surface);
    void add_chunks(const Mesh& mesh, std::span<const std::uint32_t> indices, std::span<const float> facet,
                    const ChunkTree& tree, std::span<const std::uint32_t> place_of, float surface);
    /// Until the largest are known.
    void collect_faces(std::vector<OutlinedFace> faces, std::uint32_t material);
    void keep_largest_faces();
    void list_faces();
    void bound(std::size_t first_node);
    std::uint32_t mover() const { return static_cast<std::uint32_t>(scene_->movers_.size()); }
    void end_nodes();

    std::unique_ptr<Scene> scene_;
    std::vector<SceneVertex> coarse_vertices_;
    std::vector<std::uint16_t> coarse_indices_;
    std::vector<OutlinedFace> faces_;
};

}  // namespace echoloop
