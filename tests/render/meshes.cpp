#include "tests/render/meshes.h"

#include <cmath>

#include "render/scene/welding.h"

namespace echoloop::test {

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

std::shared_ptr<const Scene> scene_of(const std::vector<Mesh>& meshes) { return Scene::from_meshes(meshes); }

std::vector<std::uint32_t> places_of(const Mesh& mesh) {
    MeshLoops loops(mesh.positions.size());
    return welded(mesh.positions, loops);
}

}  // namespace echoloop::test
