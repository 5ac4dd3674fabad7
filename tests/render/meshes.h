// Test geometry in code: simple shapes and a seabed.
#pragma once

#include <vector>

#include "render/scene/shapes.h"

namespace echoloop::test {

using shapes::box;
using shapes::floor_at;
using shapes::quad;
using shapes::sphere;
using shapes::wall_at;

/// Bumpy, about z = -6 m, of cells x cells quads on 120 m x 120 m.
Mesh seabed(int cells);

std::shared_ptr<const Scene> scene_of(const std::vector<Mesh>& meshes);

/// welded() of its positions.
std::vector<std::uint32_t> places_of(const Mesh& mesh);

}  // namespace echoloop::test
