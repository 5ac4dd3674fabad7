#include "render/scene/nodes.h"

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "render/scene/fault.h"
#include "render/scene/limits.h"

namespace echoloop {
namespace {

std::string place_of(std::size_t node) { return "nodes[" + std::to_string(node) + "]"; }

/// Of a transform given as a matrix: its axes, made perpendicular.
glm::dquat rotation_of(const glm::dmat4& m) {
    const glm::dvec3 x = glm::normalize(glm::dvec3(m[0]));
    const glm::dvec3 y = glm::normalize(glm::dvec3(m[1]) - glm::dot(glm::dvec3(m[1]), x) * x);
    return glm::normalize(glm::quat_cast(glm::dmat3(x, y, glm::cross(x, y))));
}

glm::dquat local_rotation(const GltfNode& node) {
    if (!node.matrix.empty()) return rotation_of(glm::make_mat4(node.matrix.data()));
    if (node.rotation.empty()) return {1, 0, 0, 0};
    return glm::normalize(glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]));
}

glm::dmat4 local_transform(const GltfNode& node, std::size_t index) {
    if (!node.matrix.empty()) return glm::make_mat4(node.matrix.data());
    glm::dmat4 out(1);
    if (!node.translation.empty()) out = glm::translate(out, glm::make_vec3(node.translation.data()));
    if (!node.rotation.empty()) {
        const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        const double length = glm::length(q);
        if (!(std::abs(length - 1) < 0.05))
            scene_fault(place_of(index) + ".rotation", "is not a unit quaternion", "normalise it");
        out = out * glm::mat4_cast(q / length);
    }
    if (!node.scale.empty()) out = glm::scale(out, glm::make_vec3(node.scale.data()));
    return out;
}

void check_transform(const glm::dmat4& m, std::size_t node) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!(std::abs(m[column][row]) < 1e9))
                scene_fault(place_of(node), "has a transform that is not finite or beyond 1e9",
                            "correct the transform");
    if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || std::abs(m[3][3] - 1) > 1e-6)
        scene_fault(place_of(node) + ".matrix", "is not affine", "its last row must be 0 0 0 1");
    if (!(std::abs(glm::determinant(glm::dmat3(m))) > 1e-18))
        scene_fault(place_of(node), "has a transform without volume", "give it a scale other than zero");
}

/// Every node has one parent at most, and a root none: a walk that meets a node twice has found a cycle or a
/// share.
class Walk {
  public:
    explicit Walk(const GltfModel& model) : model_(model), seen_(model.nodes().size()) {}

    void visit(std::size_t index, std::optional<std::size_t> parent, std::size_t depth,
               const std::string& place) {
        if (seen_[index])
            scene_fault(place, "meets node " + std::to_string(index) + " again",
                        "give each node one parent, without cycles");
        if (depth > scene_limits::node_depth)
            scene_fault(place, "is nested deeper than " + std::to_string(scene_limits::node_depth),
                        "flatten the node tree");
        seen_[index] = true;
        const GltfNode& node = model_.nodes()[index];
        const glm::dmat4 world_from_parent = parent ? out_[*parent].world_from_node : glm::dmat4(1);
        const glm::dmat4 world_from_node = world_from_parent * local_transform(node, index);
        check_transform(world_from_node, index);
        const glm::dquat above = parent ? out_[*parent].rotation : glm::dquat(1, 0, 0, 0);
        const std::size_t own = out_.size();
        out_.push_back({index, node.mesh, node.name.empty() ? "node" + std::to_string(index) : node.name,
                        world_from_node, above * local_rotation(node), parent});
        for (std::size_t i = 0; i < node.children.size(); ++i)
            visit(node.children[i], own, depth + 1, place_of(index) + ".children[" + std::to_string(i) + "]");
    }

    std::vector<PlacedNode> take() { return std::move(out_); }

  private:
    const GltfModel& model_;
    std::vector<bool> seen_;
    std::vector<PlacedNode> out_;
};

/// A cycle that no root reaches would go unseen by the walk.
void check_single_parents(const GltfModel& model) {
    std::vector<bool> has_parent(model.nodes().size());
    for (std::size_t n = 0; n < model.nodes().size(); ++n)
        for (std::size_t i = 0; i < model.nodes()[n].children.size(); ++i) {
            const std::size_t child = model.nodes()[n].children[i];
            if (has_parent[child])
                scene_fault(place_of(n) + ".children[" + std::to_string(i) + "]",
                            "node " + std::to_string(child) + " has another parent already",
                            "give each node one parent");
            has_parent[child] = true;
        }
}

}  // namespace

std::vector<PlacedNode> flatten_nodes(const GltfModel& model) {
    check_single_parents(model);
    Walk walk(model);
    for (const std::size_t root : model.roots())
        walk.visit(root, std::nullopt, 0, "scene root " + place_of(root));
    return walk.take();
}

}  // namespace echoloop
