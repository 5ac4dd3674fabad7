// Test geometry in code: floors, walls, boxes and spheres in ENU metres.
#pragma once

#include <vector>

#include "render/scene/scene.h"

namespace echoloop::test {

/// A quadrilateral, counter-clockwise seen from the side that scatters.
Mesh quad(const char* object, Vec3 a, Vec3 b, Vec3 c, Vec3 d, double mu_db = -27);

/// A horizontal square at height z that faces up, `cells` x `cells` quads.
Mesh floor_at(double z, double half_side, int cells = 1, double mu_db = -27);

/// Bumpy, about z = -6 m, of cells x cells quads on 120 m x 120 m.
Mesh seabed(int cells);

/// A vertical rectangle at x that faces -x, from z0 to z1 and |y| <= half_width.
Mesh wall_at(double x, double half_width, double z0, double z1, double mu_db = -27);

/// A box that faces outwards, turned by `yaw` about its own vertical axis.
Mesh box(const char* object, Vec3 centre, Vec3 size, double yaw = 0, double mu_db = -27);

/// A sphere with smooth normals; rings x (2 rings) cells.
Mesh sphere(Vec3 centre, double radius, int rings, double mu_db = -27);

std::shared_ptr<const Scene> scene_of(const std::vector<Mesh>& meshes);

/// welded() of its positions.
std::vector<std::uint32_t> places_of(const Mesh& mesh);

}  // namespace echoloop::test
