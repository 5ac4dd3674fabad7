// Where a scene lies on the Earth, without its triangles.
#pragma once

#include <filesystem>
#include <optional>

#include "render/geographic.h"

namespace echoloop {

/// As Scene::origin(), and throws as Scene::load() for whatever is wrong before the triangles are read.
std::optional<GeoPlace> scene_origin(const std::filesystem::path& file);

}  // namespace echoloop
