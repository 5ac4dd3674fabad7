#include "render/scene/reader.h"

#include <algorithm>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/mat3x3.hpp>

#include "render/scene/builder.h"
#include "render/scene/forget.h"
#include "render/scene/mesh_loops.h"
#include "render/scene/movers.h"

namespace echoloop {
namespace {

/// Corner numbers of the triangles of a list, strip or fan of `count` corners, all wound the same way.
std::vector<std::uint32_t> triangle_corners(int mode, std::size_t count) {
    std::vector<std::uint32_t> out;
    const auto triangle = [&out](std::size_t a, std::size_t b, std::size_t c) {
        for (const std::size_t corner : {a, b, c}) out.push_back(static_cast<std::uint32_t>(corner));
    };
    if (mode == 4)
        for (std::size_t i = 0; i + 2 < count; i += 3) triangle(i, i + 1, i + 2);
    if (mode == 5)
        for (std::size_t i = 0; i + 2 < count; ++i) triangle(i, i + 1 + i % 2, i + 2 - i % 2);
    if (mode == 6)
        for (std::size_t i = 1; i + 1 < count; ++i) triangle(0, i, i + 1);
    return out;
}

std::vector<std::uint32_t> read_triangles(const GltfModel& model, const GltfPrimitive& primitive,
                                          std::size_t vertices) {
    if (!primitive.indices) return triangle_corners(primitive.mode, vertices);
    auto indices = model.read_indices(*primitive.indices, vertices, primitive.place + ".indices");
    if (primitive.mode == 4) {
        indices.resize(indices.size() / 3 * 3);
        return indices;
    }
    auto corners = triangle_corners(primitive.mode, indices.size());
    for (auto& corner : corners) corner = indices[corner];
    return corners;
}

/// A transform that mirrors turns the winding round, and with it the side that scatters.
void restore_winding(std::vector<std::uint32_t>& indices) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
}

/// In the world, or in the frame of the mover that carries it, if any.
Mesh read_primitive(const GltfModel& model, const GltfPrimitive& primitive, const PlacedNode& placed,
                    const SceneDocument& document, const SceneMover* mover) {
    const Pose from_world = mover != nullptr ? inverse(mover->rest) : Pose{};
    const auto point = [&](Vec3 p) { return mover != nullptr ? from_world * p : p; };
    const auto direction = [&](Vec3 v) { return mover != nullptr ? rotate(from_world.orientation, v) : v; };
    Mesh mesh;
    mesh.object = placed.object;
    mesh.material = primitive.material ? document.materials[*primitive.material] : Material{};
    mesh.positions = model.read_vectors(primitive.positions, primitive.place + ".attributes.POSITION");
    MeshLoops loops(mesh.positions.size());
    loops.each(mesh.positions.size(), [&](std::size_t i) {
        Vec3& p = mesh.positions[i];
        p = point(enu_from_gltf(glm::dvec3(placed.world_from_node * glm::dvec4(p.x, p.y, p.z, 1))));
    });
    const glm::dmat3 linear(placed.world_from_node);
    const glm::dmat3 normal_transform = glm::inverseTranspose(linear);
    if (primitive.normals)
        mesh.normals = model.read_vectors(*primitive.normals, primitive.place + ".attributes.NORMAL");
    loops.each(mesh.normals.size(), [&](std::size_t i) {
        Vec3& n = mesh.normals[i];
        n = direction(enu_from_gltf(normal_transform * glm::dvec3(n.x, n.y, n.z)));
    });
    mesh.indices = read_triangles(model, primitive, mesh.positions.size());
    if (glm::determinant(linear) < 0) restore_winding(mesh.indices);
    return mesh;
}

bool has_area(const GltfPrimitive& primitive) { return primitive.mode >= 4; }  // points and lines have none

std::size_t primitives_of(std::span<const PlacedNode> placed, const GltfModel& model) {
    std::size_t count = 0;
    for (const PlacedNode& node : placed)
        if (node.mesh)
            count += static_cast<std::size_t>(std::ranges::count_if(model.primitives(*node.mesh), has_area));
    return count;
}

void add_target(const PlacedNode& placed, const SceneDocument& document, const SceneMover* mover,
                SceneBuilder& builder) {
    const auto strength = document.target_strengths[placed.node];
    if (!strength) return;
    const Vec3 in_world = enu_from_gltf(glm::dvec3(placed.world_from_node[3]));
    const Vec3 position = mover != nullptr ? inverse(mover->rest) * in_world : in_world;
    builder.add(PointTarget{placed.object, position, *strength},
                "nodes[" + std::to_string(placed.node) + "]");
}

}  // namespace

std::shared_ptr<const Scene> read_scene(SceneFolder::Bytes bytes, const SceneFolder& folder,
                                        const SceneOptions& options) {
    SceneDocument document = check_document(open_container(bytes), folder, options.animations);
    const GltfModel model(document);
    SceneBuilder builder;
    const auto placed = flatten_nodes(model);
    const MoverPlan plan = plan_movers(document, model, placed, options);
    std::size_t unread = primitives_of(placed, model);
    const auto read = [&](const GltfPrimitive& primitive, const PlacedNode& node, const SceneMover* mover) {
        Mesh mesh = read_primitive(model, primitive, node, document, mover);
        if (--unread == 0)
            document.buffers.clear(), forget(document.files), forget(bytes);  // as large as the mesh
        return mesh;
    };
    const auto add_all_of = [&](std::uint32_t number, const SceneMover* mover) {
        for (std::size_t i = 0; i < placed.size(); ++i) {
            if (plan.of[i] != number) continue;
            add_target(placed[i], document, mover, builder);
            if (!placed[i].mesh) continue;
            for (const auto& primitive : model.primitives(*placed[i].mesh))
                if (has_area(primitive)) builder.add(read(primitive, placed[i], mover), primitive.place);
        }
    };
    add_all_of(0, nullptr);
    for (std::uint32_t number = 1; number <= plan.movers.size(); ++number) {
        builder.begin(plan.movers[number - 1]);
        add_all_of(number, &plan.movers[number - 1]);
    }
    for (const auto& node : placed) builder.add_name(node.object);
    for (const auto& note : plan.notes) builder.add_note(note);
    builder.set_origin(document.origin);
    return builder.finish();
}

}  // namespace echoloop
