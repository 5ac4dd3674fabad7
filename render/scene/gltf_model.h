// A glTF document that tinygltf has parsed, with bounds-checked reading of its accessors. The only file pair
// of the project that includes tinygltf; it gives tinygltf no access to the file system.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/pose.h"
#include "render/scene/document.h"

namespace echoloop {

/// One part of a mesh; the places name it in complaints.
struct GltfPrimitive {
    std::string place;
    int mode = 4;  ///< glTF: 4 triangles, 5 strip, 6 fan; less are points and lines
    std::size_t positions = 0;
    std::optional<std::size_t> normals, indices, material;
};

struct GltfNode {
    std::string name;
    std::optional<std::size_t> mesh;
    std::vector<std::size_t> children;
    std::vector<double> matrix, translation, rotation, scale;  ///< empty where absent
};

class GltfModel {
  public:
    /// Looks into the document until it dies. Throws SceneFault when tinygltf refuses it.
    explicit GltfModel(const SceneDocument& document);
    ~GltfModel();
    GltfModel(const GltfModel&) = delete;
    GltfModel& operator=(const GltfModel&) = delete;

    const std::vector<GltfNode>& nodes() const { return nodes_; }
    const std::vector<std::size_t>& roots() const { return roots_; }
    const std::vector<GltfPrimitive>& primitives(std::size_t mesh) const { return meshes_[mesh]; }

    /// Finite VEC3 floats. `place` is where the accessor is used. Throws SceneFault.
    std::vector<Vec3> read_vectors(std::size_t accessor, const std::string& place) const;
    /// Finite SCALAR floats, at least one. Throws SceneFault.
    std::vector<float> read_scalars(std::size_t accessor, const std::string& place) const;
    /// Finite vectors of `parts` floats, 3 or 4; a fourth that is missing is 0. Throws SceneFault.
    std::vector<std::array<float, 4>> read_values(std::size_t accessor, std::size_t parts,
                                                  const std::string& place) const;
    /// Unsigned SCALAR indices, each below `count`. Throws SceneFault.
    std::vector<std::uint32_t> read_indices(std::size_t accessor, std::size_t count,
                                            const std::string& place) const;

  private:
    struct Parsed;
    struct Elements;
    Elements elements(std::size_t accessor, const std::string& place) const;
    void copy_nodes();
    void copy_meshes();

    std::unique_ptr<Parsed> parsed_;
    const SceneDocument& document_;
    std::vector<GltfNode> nodes_;
    std::vector<std::size_t> roots_;
    std::vector<std::vector<GltfPrimitive>> meshes_;
};

}  // namespace echoloop
