// What is wrong with a scene, before it is known which file it came from. Thrown inside render/scene only;
// Scene::load and Scene::from_meshes turn it into a SceneError.
#pragma once

#include <string>

namespace echoloop {

struct SceneFault {
    std::string place;   ///< JSON path, empty for the whole file
    std::string reason;  ///< what is wrong
    std::string remedy;  ///< what to do
};

inline constexpr const char* export_again = "export the scene again as glTF 2.0";

[[noreturn]] inline void scene_fault(std::string place, std::string reason, std::string remedy) {
    throw SceneFault{std::move(place), std::move(reason), std::move(remedy)};
}

}  // namespace echoloop
