// The triangles of one visual, before it is known what they are made of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/pose.h"

namespace echoloop::worlds {

struct ShapeSurface {
    std::vector<Vec3> positions{};
    std::vector<std::uint32_t> indices{};
    std::string material{};     ///< its name in the file of the mesh; empty: none
    bool double_sided = false;  ///< its sides are not known, or both count
};

using Shape = std::vector<ShapeSurface>;

std::size_t triangles_of(const Shape& shape);

/// Finds out whether triangles enclose something, all with their outsides outwards. Those that do with their
/// insides outwards are turned; all others count on both sides: what is open, or of mixed winding, would be
/// invisible from one of them.
void settle_sides(ShapeSurface& surface);

}  // namespace echoloop::worlds
