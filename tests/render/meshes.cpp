#include "tests/render/meshes.h"

#include <cmath>
#include <numbers>

#include "render/scene/welding.h"

namespace echoloop::test {
namespace {

void add_quad(Mesh& mesh, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + corner);
}

Mesh mesh_of(const char* object, double mu_db) {
    Mesh mesh;
    mesh.object = object;
    mesh.material = {object, mu_db, false};
    return mesh;
}

}  // namespace

Mesh quad(const char* object, Vec3 a, Vec3 b, Vec3 c, Vec3 d, double mu_db) {
    Mesh mesh = mesh_of(object, mu_db);
    add_quad(mesh, a, b, c, d);
    return mesh;
}

Mesh floor_at(double z, double half_side, int cells, double mu_db) {
    Mesh mesh = mesh_of("floor", mu_db);
    const double step = 2 * half_side / cells;
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
            const double x = -half_side + i * step, y = -half_side + j * step;
            add_quad(mesh, {x, y, z}, {x + step, y, z}, {x + step, y + step, z}, {x, y + step, z});
        }
    return mesh;
}

Mesh seabed(int cells) {
    const double half = 60, step = 2 * half / cells;
    const auto height = [](double x, double y) {
        return 0.25 * (std::sin(0.9 * x) * std::cos(0.7 * y) + 0.4 * std::sin(2.3 * x + 1.7 * y));
    };
    Mesh mesh;
    mesh.object = "seabed";
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= cells; ++column) {
            const double x = -half + column * step, y = -half + row * step, d = 1e-4;
            mesh.positions.push_back({x, y, -6 + height(x, y)});
            mesh.normals.push_back({(height(x - d, y) - height(x + d, y)) / (2 * d),
                                    (height(x, y - d) - height(x, y + d)) / (2 * d), 1});
        }
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column) {
            const auto i = static_cast<std::uint32_t>(row * (cells + 1) + column), above = i + cells + 1;
            for (const std::uint32_t corner : {i, i + 1, above + 1, i, above + 1, above})
                mesh.indices.push_back(corner);
        }
    return mesh;
}

Mesh wall_at(double x, double half_width, double z0, double z1, double mu_db) {
    return quad("wall", {x, half_width, z0}, {x, -half_width, z0}, {x, -half_width, z1}, {x, half_width, z1},
                mu_db);
}

Mesh box(const char* object, Vec3 centre, Vec3 size, double yaw, double mu_db) {
    const Pose world_from_box{centre, axis_angle({0, 0, 1}, yaw)};
    const auto corner = [&](int x, int y, int z) {
        return world_from_box * Vec3{x * size.x / 2, y * size.y / 2, z * size.z / 2};
    };
    Mesh mesh = mesh_of(object, mu_db);
    add_quad(mesh, corner(-1, -1, -1), corner(-1, -1, 1), corner(-1, 1, 1), corner(-1, 1, -1));
    add_quad(mesh, corner(1, -1, -1), corner(1, 1, -1), corner(1, 1, 1), corner(1, -1, 1));
    add_quad(mesh, corner(-1, -1, -1), corner(1, -1, -1), corner(1, -1, 1), corner(-1, -1, 1));
    add_quad(mesh, corner(-1, 1, -1), corner(-1, 1, 1), corner(1, 1, 1), corner(1, 1, -1));
    add_quad(mesh, corner(-1, -1, 1), corner(1, -1, 1), corner(1, 1, 1), corner(-1, 1, 1));
    add_quad(mesh, corner(-1, -1, -1), corner(-1, 1, -1), corner(1, 1, -1), corner(1, -1, -1));
    return mesh;
}

Mesh sphere(Vec3 centre, double radius, int rings, double mu_db) {
    Mesh mesh = mesh_of("sphere", mu_db);
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

std::shared_ptr<const Scene> scene_of(const std::vector<Mesh>& meshes) { return Scene::from_meshes(meshes); }

std::vector<std::uint32_t> places_of(const Mesh& mesh) {
    MeshLoops loops(mesh.positions.size());
    return welded(mesh.positions, loops);
}

}  // namespace echoloop::test
