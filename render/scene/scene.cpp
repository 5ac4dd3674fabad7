#include "render/scene/scene.h"

#include <algorithm>
#include <utility>

#include "render/scene/builder.h"
#include "render/scene/fault.h"
#include "render/scene/limits.h"
#include "render/scene/reader.h"

namespace echoloop {
namespace {

std::string sentence(const std::string& file, const std::string& place, const std::string& reason,
                     const std::string& remedy) {
    std::string out = file + ": ";
    if (!place.empty()) out.append(place).append(" ");
    return out.append(reason).append("; ").append(remedy);
}

}  // namespace

SceneError::SceneError(std::string file, std::string place, std::string reason, std::string remedy)
    : std::runtime_error(sentence(file, place, reason, remedy)),
      file_(std::move(file)),
      place_(std::move(place)),
      reason_(std::move(reason)),
      remedy_(std::move(remedy)) {}

std::shared_ptr<const Scene> Scene::load(const std::filesystem::path& file, const SceneOptions& options) try {
    const SceneFolder folder(file);
    return read_scene(folder.read_scene(scene_limits::json_bytes + scene_limits::buffer_bytes), folder,
                      options);
} catch (const SceneFault& fault) {
    throw SceneError(file.string(), fault.place, fault.reason, fault.remedy);
} catch (const std::bad_alloc&) {
    throw SceneError(file.string(), "", "the scene does not fit into memory", "simplify its meshes");
}

std::shared_ptr<const Scene> Scene::from_meshes(std::span<const Mesh> meshes,
                                                std::span<const PointTarget> targets,
                                                std::span<const std::string> movable) try {
    SceneBuilder builder;
    const auto add = [&](const auto& wanted) {
        for (std::size_t i = 0; i < meshes.size(); ++i)
            if (wanted(meshes[i].object)) builder.add(meshes[i], "meshes[" + std::to_string(i) + "]");
    };
    add([&](const std::string& object) { return std::ranges::find(movable, object) == movable.end(); });
    for (std::size_t i = 0; i < targets.size(); ++i)
        builder.add(targets[i], "targets[" + std::to_string(i) + "]");
    for (const std::string& name : movable) {
        builder.begin({.name = name, .bounds = empty_bounds()});
        add([&](const std::string& object) { return object == name; });
    }
    return builder.finish();
} catch (const SceneFault& fault) {
    throw SceneError("meshes", fault.place, fault.reason, fault.remedy);
}

std::shared_ptr<const Scene> Scene::from_own_meshes(std::vector<Mesh> meshes) try {
    SceneBuilder builder;
    for (std::size_t i = 0; i < meshes.size(); ++i)
        builder.add(std::move(meshes[i]), "meshes[" + std::to_string(i) + "]");
    return builder.finish();
} catch (const SceneFault& fault) {
    throw SceneError("meshes", fault.place, fault.reason, fault.remedy);
}

}  // namespace echoloop
