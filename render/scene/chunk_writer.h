// Puts triangles of a mesh into chunks: each with vertices of its own, which its indices count.
#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/corner_normal.h"
#include "render/scene/scene.h"

namespace echoloop {

/// Writes a mesh's chunks, one after the other.
class ChunkWriter {
  public:
    ChunkWriter(const Mesh& mesh, float surface, std::vector<SceneVertex>& vertices,
                std::vector<std::uint16_t>& indices)
        : mesh_(mesh),
          surface_(surface),
          vertices_(vertices),
          indices_(indices),
          last_chunk_(mesh.positions.size()),
          local_(mesh.positions.size()) {}

    void begin() {
        ++number_;
        chunk_ = {};
        chunk_.first_vertex = static_cast<std::uint32_t>(vertices_.size());
        chunk_.first_index = static_cast<std::uint32_t>(indices_.size());
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
        if (smooth && last_chunk_[index] == number_) return local_[index];
        const auto local = static_cast<std::uint16_t>(vertices_.size() - chunk_.first_vertex);
        vertices_.push_back({floats(mesh_.positions[index]), floats(normal), surface_});
        grow(chunk_.bounds, vertices_.back().position);
        if (smooth) last_chunk_[index] = number_, local_[index] = local;
        return local;
    }

    const Mesh& mesh_;
    const float surface_;
    std::vector<SceneVertex>& vertices_;
    std::vector<std::uint16_t>& indices_;
    std::vector<std::uint32_t> last_chunk_;  ///< that had a vertex with a normal of its own, counted from 1
    std::vector<std::uint16_t> local_;       ///< number there
    std::uint32_t number_ = 0;
    SceneChunk chunk_;
};

}  // namespace echoloop
