#include "tools/echoloop/bench/scenes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "render/scene/mesh_loops.h"

namespace echoloop::bench {
namespace {

using Kind = SceneRow::Kind;
constexpr std::array<SceneRow, 7> rows{{{"simple", 1, 0},
                                        {"big100k", 224, 0.25},
                                        {"big2m", 1000, 0.25},
                                        {"one1m", 707, 0.25, Kind::one_mesh},
                                        {"one2m", 1000, 0.25, Kind::one_mesh},
                                        {"terrain", 700, 0.9, Kind::terrain},
                                        {"stones", 224, 0.25, Kind::stones}}};
constexpr double half = 60, depth = 6;

struct Box {
    Vec3 centre, size;
    double yaw = 0;
};
constexpr std::array<Box, 11> boxes{{{{15, 0, -4.75}, {2, 3, 2.5}, 0.3},
                                     {{20, 7, -5}, {2, 2, 2}, 0.8},
                                     {{18, -8, -5}, {1.5, 4, 2}, -0.5},
                                     {{24, -3, -5}, {3, 1.5, 2}, 0.1},
                                     {{26, 12, -4.5}, {2, 2, 3}, 0},
                                     {{-14, 6, -2}, {3, 3, 8}, 0.4},
                                     {{-8, -16, -2}, {2, 5, 8}, 1},
                                     {{30, 0, -1.5}, {0.4, 60, 9}, 0},
                                     {{-30, 0, -1.5}, {0.4, 60, 9}, 0},
                                     {{0, 30, -1.5}, {60, 0.4, 9}, 0},
                                     {{0, -30, -1.5}, {60, 0.4, 9}, 0}}};
constexpr std::size_t walls = 4;  // the last ones

Vec3 unit(Vec3 v) { return 1 / norm(v) * v; }

Mesh mesh_of(const char* object) {
    Mesh mesh;
    mesh.object = object;
    mesh.material.name = "sand";
    return mesh;
}

void add_quad(Mesh& mesh, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
    mesh.normals.insert(mesh.normals.end(), 4, unit(cross(b - a, d - a)));
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + corner);
}

void add_box(Mesh& mesh, const Box& box) {
    const Pose world_from_box{box.centre, axis_angle({0, 0, 1}, box.yaw)};
    const auto corner = [&](int x, int y, int z) {
        return world_from_box * Vec3{x * box.size.x / 2, y * box.size.y / 2, z * box.size.z / 2};
    };
    add_quad(mesh, corner(-1, -1, -1), corner(-1, -1, 1), corner(-1, 1, 1), corner(-1, 1, -1));
    add_quad(mesh, corner(1, -1, -1), corner(1, 1, -1), corner(1, 1, 1), corner(1, -1, 1));
    add_quad(mesh, corner(-1, -1, -1), corner(1, -1, -1), corner(1, -1, 1), corner(-1, -1, 1));
    add_quad(mesh, corner(-1, 1, -1), corner(-1, 1, 1), corner(1, 1, 1), corner(1, 1, -1));
    add_quad(mesh, corner(-1, -1, 1), corner(1, -1, 1), corner(1, 1, 1), corner(-1, 1, 1));
    add_quad(mesh, corner(-1, -1, -1), corner(-1, 1, -1), corner(1, 1, -1), corner(1, -1, -1));
}

/// Two triangles a cell of a lattice whose vertices, row by row, are in the mesh from `base` on.
void add_lattice(Mesh& mesh, std::size_t base, int lattice_rows, int columns) {
    mesh.indices.reserve(mesh.indices.size() + static_cast<std::size_t>(lattice_rows) * columns * 6);
    for (int r = 0; r < lattice_rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const auto i = static_cast<std::uint32_t>(base + static_cast<std::size_t>(r) * (columns + 1) + c);
            const auto j = static_cast<std::uint32_t>(i + columns + 1);
            for (const std::uint32_t corner : {i, i + 1, j + 1, i, j + 1, j}) mesh.indices.push_back(corner);
        }
}

void add_ball(Mesh& mesh, Vec3 centre, double radius) {
    constexpr int around = 32, down = 16;
    const std::size_t base = mesh.positions.size();
    for (int c = 0; c <= around; ++c)
        for (int r = 0; r <= down; ++r) {
            const double theta = std::numbers::pi * r / down, phi = 2 * std::numbers::pi * c / around;
            const Vec3 n{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
            mesh.positions.push_back(centre + radius * n);
            mesh.normals.push_back(n);
        }
    add_lattice(mesh, base, around, down);
}

/// Of x, y and what they are multiplied by: sines and cosines along one side of the seabed.
struct Waves {
    Waves(int cells, double per_metre) {
        for (int i = 0; i <= cells; ++i) {
            const double x = -half + 2 * half * i / cells;
            sine.push_back(std::sin(per_metre * x)), cosine.push_back(std::cos(per_metre * x));
        }
    }
    std::vector<double> sine, cosine;
};

/// Waves of a few metres' length, and their slope. By all threads, as a file's vertices are read.
Mesh seabed(const SceneRow& row) {
    Mesh mesh = mesh_of("seabed");
    const auto side = static_cast<std::size_t>(row.cells) + 1;
    mesh.positions.resize(side * side);
    mesh.normals.resize(side * side);
    const Waves along_x(row.cells, 0.9), along_y(row.cells, 0.7);
    MeshLoops(side * side).each(side * side, [&](std::size_t i) {
        const std::size_t r = i / side, c = i % side;
        const double x = -half + 2 * half * static_cast<double>(c) / row.cells,
                     y = -half + 2 * half * static_cast<double>(r) / row.cells;
        const double phase = 2.3 * x + 1.7 * y, cross_swell = 0.4 * std::cos(phase), a = row.amplitude;
        const double height = a * (along_x.sine[c] * along_y.cosine[r] + 0.4 * std::sin(phase));
        const double dx = a * (0.9 * along_x.cosine[c] * along_y.cosine[r] + 2.3 * cross_swell);
        const double dy = a * (-0.7 * along_x.sine[c] * along_y.sine[r] + 1.7 * cross_swell);
        mesh.positions[i] = {x, y, height - depth};
        mesh.normals[i] = unit({-dx, -dy, 1});
    });
    add_lattice(mesh, 0, row.cells, row.cells);
    return mesh;
}

Mesh objects() {
    Mesh mesh = mesh_of("objects");
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (i == boxes.size() - walls) add_ball(mesh, {19, 3, -4.8}, 1.2);
        add_box(mesh, boxes[i]);
    }
    return mesh;
}

/// -1..1, the same on every machine.
double chance(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    std::uint64_t h = a * 0x9E3779B97F4A7C15U + b * 0xC2B2AE3D27D4EB4FU + c * 0x165667B19E3779F9U + 1;
    for (int i = 0; i < 2; ++i) h = (h ^ (h >> 29U)) * 0xBF58476D1CE4E5B9U;
    return static_cast<double>(h >> 11U) / static_cast<double>(1ULL << 52U) - 1;
}

/// Smooth between the chances at the corners of unit squares; x and y are positive.
double value_noise(std::uint64_t octave, double x, double y) {
    const double column = std::floor(x), row = std::floor(y);
    const auto eased = [](double t) { return t * t * (3 - 2 * t); };
    const double u = eased(x - column), v = eased(y - row);
    const auto corner = [&](int right, int up) {
        return chance(octave, static_cast<std::uint64_t>(column) + static_cast<std::uint64_t>(right),
                      static_cast<std::uint64_t>(row) + static_cast<std::uint64_t>(up));
    };
    return (1 - v) * ((1 - u) * corner(0, 0) + u * corner(1, 0)) +
           v * ((1 - u) * corner(0, 1) + u * corner(1, 1));
}

/// Hills of tens of metres down to ripples of decimetres, as surveys find them: heights fall nearly as fast
/// as lengths (value noise in nine octaves).
double terrain_height(double amplitude, double x, double y) {
    double height = 0, size = 48;
    for (std::uint64_t octave = 0; octave < 9; ++octave, size /= 2, amplitude *= 0.55)
        height += amplitude * value_noise(octave, (x + 2 * half) / size, (y + 2 * half) / size);
    return height - depth;
}

/// Its vertices lie on no lattice.
Mesh terrain(const SceneRow& row) {
    Mesh mesh = mesh_of("terrain");
    constexpr double step = 0.02;
    const double cell = 2 * half / row.cells;
    for (int r = 0; r <= row.cells; ++r)
        for (int c = 0; c <= row.cells; ++c) {
            const auto i = static_cast<std::uint64_t>(r), j = static_cast<std::uint64_t>(c);
            const bool border = r == 0 || c == 0 || r == row.cells || c == row.cells;
            const double off = border ? 0 : 0.35 * cell;
            const double x = -half + cell * c + off * chance(100, i, j),
                         y = -half + cell * r + off * chance(101, i, j);
            const auto height = [&](double dx, double dy) {
                return terrain_height(row.amplitude, x + dx, y + dy);
            };
            mesh.positions.push_back({x, y, height(0, 0)});
            mesh.normals.push_back(
                unit({height(-step, 0) - height(step, 0), height(0, -step) - height(0, step), 2 * step}));
        }
    add_lattice(mesh, 0, row.cells, row.cells);
    return mesh;
}

/// A thousand boxes and balls of 0.1 to 0.5 m on the bottom, each an object of its own.
void add_stones(std::vector<Mesh>& meshes) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const auto between = [&](std::uint64_t what, double low, double high) {
            return low + (high - low) * (chance(200, i, what) + 1) / 2;
        };
        meshes.push_back(mesh_of(("stone" + std::to_string(i)).c_str()));
        meshes.back().material.name = "rock";
        const Vec3 centre{between(0, -29, 29), between(1, -29, 29), -depth};
        const double size = between(2, 0.1, 0.5);
        if (i % 3 == 0)
            add_ball(meshes.back(), centre, size / 2);
        else
            add_box(meshes.back(),
                    {centre, {size, between(3, 0.1, 0.5), between(4, 0.3, 0.8)}, between(5, 0, 3)});
    }
}

/// As one mesh, as scanners and CAD programs export.
void join(std::vector<Mesh>& meshes) {
    Mesh& all = meshes.front();
    for (std::size_t i = 1; i < meshes.size(); ++i) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        all.positions.insert(all.positions.end(), meshes[i].positions.begin(), meshes[i].positions.end());
        all.normals.insert(all.normals.end(), meshes[i].normals.begin(), meshes[i].normals.end());
        for (const std::uint32_t corner : meshes[i].indices) all.indices.push_back(first + corner);
    }
    meshes.resize(1);
}

}  // namespace

std::span<const SceneRow> scene_rows() { return rows; }

std::vector<Mesh> scene_meshes(std::string_view name) {
    for (const SceneRow& row : rows)
        if (row.name == name) {
            std::vector<Mesh> meshes;
            meshes.push_back(row.kind == Kind::terrain ? terrain(row) : seabed(row));
            if (row.kind == Kind::terrain) return meshes;
            meshes.push_back(objects());
            if (row.kind == Kind::one_mesh) join(meshes);
            if (row.kind == Kind::stones) add_stones(meshes);
            return meshes;
        }
    throw std::invalid_argument("bench: there is no scene " + std::string(name));
}

}  // namespace echoloop::bench
