// Which triangles of a mesh share an edge. Knows no surface.
#pragma once

#include <cstdint>
#include <span>

#include "render/scene/mesh_loops.h"
#include "render/scene/scene.h"
#include "render/scene/scratch.h"

namespace echoloop {

/// Triangles by their corners' places, whatever vertices the file repeats.
class Neighbours {
  public:
    static constexpr std::uint32_t none = ~0U;

    /// `places`: of every vertex that of the first one there. `normals`: of the triangles, unit.
    Neighbours(std::span<const std::uint32_t> places, std::span<const std::uint32_t> indices,
               std::span<const Vec3> normals, MeshLoops& loops);

    /// The place of a corner: the number of the first vertex there.
    std::uint32_t corner(std::uint32_t triangle, unsigned side) const {
        return corners_[3 * std::size_t{triangle} + side % 3];
    }
    /// Beyond the edge from corner `side` to the next: of those wound the same way the one that bends least,
    /// or none, as where very many triangles meet.
    std::uint32_t beyond(std::uint32_t triangle, unsigned side) const {
        return beyond_[3 * std::size_t{triangle} + side];
    }

  private:
    Scratch<std::uint32_t> corners_, beyond_;
};

}  // namespace echoloop
