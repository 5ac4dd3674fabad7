// Which vertices of a mesh are at one place, whatever the file repeats.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/scene/mesh_loops.h"
#include "render/scene/scene.h"

namespace echoloop {

/// Of every vertex the first one within the same cell of a thousandth of a millimetre, so that the poles of a
/// sphere are one place.
std::vector<std::uint32_t> welded(std::span<const Vec3> positions, MeshLoops& loops);

}  // namespace echoloop
