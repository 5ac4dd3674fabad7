// Checks a glTF document before tinygltf sees it and hands on only what a sonar needs: no images, no
// extensions, and no file name that tinygltf could open. Animations pass it by.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/container.h"
#include "render/scene/document_animations.h"
#include "render/scene/folder.h"
#include "render/scene/scene.h"

namespace echoloop {

struct SceneDocument {
    /// Checked glTF; buffer i has a data: URI, or one byte and the URI buffer_uri(i).
    std::string json;
    /// Contents of buffer i, of the scene file or of a file in `files`; empty for a data: URI.
    std::vector<std::span<const unsigned char>> buffers;
    std::vector<SceneFolder::Bytes> files;
    std::vector<Material> materials;                      ///< in the order of the file
    std::vector<bool> sparse;                             ///< per accessor
    std::vector<std::optional<double>> target_strengths;  ///< dB, per node; empty: no target
    std::optional<GeoPlace> origin{};                     ///< of the scene that is shown
    std::vector<DocumentChannel> channels;                ///< of animations, in the order of the file
    std::size_t channels_left_out = 0;                    ///< of scale and morph weights
};

std::string buffer_uri(std::size_t index);

/// The document looks into the container. Throws SceneFault with the JSON path of the first fault.
/// `animations`: read them, else they are not even looked at.
SceneDocument check_document(const SceneContainer& container, const SceneFolder& folder,
                             bool animations = false);

}  // namespace echoloop
