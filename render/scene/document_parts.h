// The checks of the single parts of a glTF document. Each returns a copy with only the members that matter
// and throws SceneFault; none reads binary data.
#pragma once

#include "render/scene/json_view.h"
#include "render/scene/scene.h"

namespace echoloop {

struct DocumentCounts {
    std::size_t buffers, views, accessors, materials, meshes, nodes, scenes;
};

using DocumentCheck = nlohmann::json (*)(const JsonView& part, const DocumentCounts& counts);

/// Checks all elements of the array `key`.
nlohmann::json check_each(const JsonView& root, const char* key, const DocumentCounts& counts,
                          DocumentCheck check);

nlohmann::json check_buffer_view(const JsonView& view, const DocumentCounts& counts);
nlohmann::json check_accessor(const JsonView& accessor, const DocumentCounts& counts);
nlohmann::json check_material(const JsonView& material, const DocumentCounts& counts);
nlohmann::json check_mesh(const JsonView& mesh, const DocumentCounts& counts);
nlohmann::json check_node(const JsonView& node, const DocumentCounts& counts);
nlohmann::json check_scene(const JsonView& scene, const DocumentCounts& counts);

/// Name, doubleSided and extras.sonar. An unknown key of extras.sonar is a fault that names the nearest known
/// one.
Material read_material(const JsonView& material);

/// dB, from extras.sonar.target_strength_db of a node; empty where there is none. Any other key of
/// extras.sonar is a fault.
std::optional<double> read_target_strength(const JsonView& node);

/// From extras.sonar.origin of a scene; empty where there is none. Any other key there is a fault.
std::optional<GeoPlace> read_origin(const JsonView& scene);

}  // namespace echoloop
