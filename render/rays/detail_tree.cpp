#include "render/rays/detail_tree.h"

namespace echoloop::rays {
namespace {

std::array<float, 4> values_of(const SceneVertex& vertex) {
    return {vertex.normal[0], vertex.normal[1], vertex.normal[2], vertex.surface + 0.25F};
}

std::array<float, 4> difference(const std::array<float, 4>& a, const std::array<float, 4>& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]};
}

}  // namespace

DetailTree::DetailTree(const embree::Device& device, const Scene& scene, gl::NodeRange range, Vec3 eye,
                       double radius, const gl::ViewLimits& limits) {
    const auto nodes = gl::find_around(scene, range, eye, radius, limits);
    chunks_ = nodes.size();
    const auto vertices = scene.all_vertices();
    for (const std::uint32_t number : nodes) {
        const SceneNode& node = scene.nodes()[number];
        const unsigned geometry = scene.materials()[node.material].double_sided ? 1 : 0;
        const std::size_t first_vertex = node.first_vertex + (node.coarse ? scene.vertices().size() : 0),
                          first_index = node.first_index + (node.coarse ? scene.indices().size() : 0);
        const auto indices = scene.all_indices().subspan(first_index, node.indices);
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            const std::size_t corner[3] = {first_vertex + indices[i], first_vertex + indices[i + 1],
                                           first_vertex + indices[i + 2]};
            const auto first = values_of(vertices[corner[0]]);
            corners_[geometry].push_back({first, difference(values_of(vertices[corner[1]]), first),
                                          difference(values_of(vertices[corner[2]]), first)});
            for (const std::size_t each : corner)
                indices_[geometry].push_back(static_cast<std::uint32_t>(each));
        }
    }
    tree_.reset(rtcNewScene(device.get()));
    for (unsigned geometry = 0; geometry < 2; ++geometry) attach(device, scene, geometry);
    rtcCommitScene(tree_.get());
    embree::check_tree_of(device);
}

void DetailTree::attach(const embree::Device& device, const Scene& scene, unsigned geometry) {
    const auto& indices = indices_[geometry];
    if (indices.empty()) return;
    const embree::Geometry mesh(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    // The position is followed by the normal, so that reading 16 bytes for a vertex stays within it.
    rtcSetSharedGeometryBuffer(mesh.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               scene.all_vertices().data(), 0, sizeof(SceneVertex),
                               scene.all_vertices().size());
    rtcSetSharedGeometryBuffer(mesh.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(), 0,
                               3 * sizeof(std::uint32_t), indices.size() / 3);
    rtcCommitGeometry(mesh.get());
    rtcAttachGeometryByID(tree_.get(), mesh.get(), geometry);
}

/// A tree takes about as much for a triangle as we do ourselves.
std::size_t DetailTree::bytes() const {
    return triangles() * 2 * (sizeof(TriangleCorners) + 3 * sizeof(std::uint32_t));
}

}  // namespace echoloop::rays
