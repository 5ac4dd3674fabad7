// Checks a glTF document before tinygltf sees it and hands on only what a sonar needs: no images, no
// animations, no extensions, and no file name that tinygltf could open.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/container.h"
#include "render/scene/folder.h"
#include "render/scene/scene.h"

namespace echoloop {

struct SceneDocument {
    std::string json;  ///< checked glTF; buffer i has the URI buffer_uri(i), or is a data: URI
    std::vector<SceneFolder::Bytes> buffers;              ///< contents of buffer i; empty for a data: URI
    std::vector<Material> materials;                      ///< in the order of the file
    std::vector<bool> sparse;                             ///< per accessor
    std::vector<std::optional<double>> target_strengths;  ///< dB, per node; empty: no target
};

std::string buffer_uri(std::size_t index);

/// Throws SceneFault with the JSON path of the first fault.
SceneDocument check_document(const SceneContainer& container, const SceneFolder& folder);

}  // namespace echoloop
