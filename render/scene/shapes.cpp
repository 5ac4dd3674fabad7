#include "render/scene/shapes.h"

#include <cmath>
#include <numbers>

namespace echoloop::shapes {
namespace {

void add_face(Mesh& mesh, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + corner);
}

Mesh shape_of(const char* object, double mu_db) {
    Mesh mesh;
    mesh.object = object;
    mesh.material = {object, mu_db, false};
    return mesh;
}

}  // namespace

Mesh quad(const char* object, Vec3 a, Vec3 b, Vec3 c, Vec3 d, double mu_db) {
    Mesh mesh = shape_of(object, mu_db);
    add_face(mesh, a, b, c, d);
    return mesh;
}

Mesh floor_at(double z, double half_side, int cells, double mu_db) {
    Mesh mesh = shape_of("floor", mu_db);
    const double step = 2 * half_side / cells;
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
            const double x = -half_side + i * step, y = -half_side + j * step;
            add_face(mesh, {x, y, z}, {x + step, y, z}, {x + step, y + step, z}, {x, y + step, z});
        }
    return mesh;
}

Mesh wall_at(double x, double half_width, double bottom, double top, double mu_db) {
    return quad("wall", {x, half_width, bottom}, {x, -half_width, bottom}, {x, -half_width, top},
                {x, half_width, top}, mu_db);
}

Mesh box(const char* object, Vec3 centre, Vec3 size, double yaw, double mu_db) {
    const Pose world_from_box{centre, axis_angle({0, 0, 1}, yaw)};
    const auto corner = [&](int x, int y, int z) {
        return world_from_box * Vec3{x * size.x / 2, y * size.y / 2, z * size.z / 2};
    };
    Mesh mesh = shape_of(object, mu_db);
    add_face(mesh, corner(-1, -1, -1), corner(-1, -1, 1), corner(-1, 1, 1), corner(-1, 1, -1));
    add_face(mesh, corner(1, -1, -1), corner(1, 1, -1), corner(1, 1, 1), corner(1, -1, 1));
    add_face(mesh, corner(-1, -1, -1), corner(1, -1, -1), corner(1, -1, 1), corner(-1, -1, 1));
    add_face(mesh, corner(-1, 1, -1), corner(-1, 1, 1), corner(1, 1, 1), corner(1, 1, -1));
    add_face(mesh, corner(-1, -1, 1), corner(1, -1, 1), corner(1, 1, 1), corner(-1, 1, 1));
    add_face(mesh, corner(-1, -1, -1), corner(-1, 1, -1), corner(1, 1, -1), corner(1, -1, -1));
    return mesh;
}

Mesh sphere(Vec3 centre, double radius, int rings, double mu_db) {
    Mesh mesh = shape_of("sphere", mu_db);
    const int around = 2 * rings;
    for (int j = 0; j <= rings; ++j)
        for (int i = 0; i <= around; ++i) {
            const double polar = std::numbers::pi * j / rings, azimuth = 2 * std::numbers::pi * i / around;
            const Vec3 n{std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                         std::cos(polar)};
            mesh.positions.push_back(centre + radius * n);
            mesh.normals.push_back(n);
        }
    for (int j = 0; j < rings; ++j)
        for (int i = 0; i < around; ++i) {
            const auto a = static_cast<std::uint32_t>(j * (around + 1) + i), below = a + around + 1;
            for (const std::uint32_t corner : {a, below, below + 1, a, below + 1, a + 1})
                mesh.indices.push_back(corner);
        }
    return mesh;
}

}  // namespace echoloop::shapes
