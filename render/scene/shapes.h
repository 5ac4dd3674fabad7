// Simple meshes made in code, for scenes without a file: ENU metres, Lambert's constant `mu_db` in dB.
#pragma once

#include "render/scene/scene.h"

namespace echoloop::shapes {

/// A quadrilateral, counter-clockwise seen from the side that scatters.
Mesh quad(const char* object, Vec3 a, Vec3 b, Vec3 c, Vec3 d, double mu_db = -27);

/// A horizontal square around (0, 0, z) that faces up, `cells` x `cells` quads.
Mesh floor_at(double z, double half_side, int cells = 1, double mu_db = -27);

/// A vertical rectangle at x that faces -x, from `bottom` to `top` and |y| <= half_width.
Mesh wall_at(double x, double half_width, double bottom, double top, double mu_db = -27);

/// A box that faces outwards, turned by `yaw` (rad) about its own vertical axis.
Mesh box(const char* object, Vec3 centre, Vec3 size, double yaw = 0, double mu_db = -27);

/// A sphere with smooth normals; rings x (2 rings) cells.
Mesh sphere(Vec3 centre, double radius, int rings, double mu_db = -27);

}  // namespace echoloop::shapes
