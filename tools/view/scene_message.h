// A scene as a page draws it: triangles of what stands still and of what moves, coarser where there are very
// many.
#pragma once

#include <string>

#include "render/scene/scene.h"

namespace echoloop::view {

/// Four bytes of length (little endian), that much JSON, then three floats (little endian) for each corner of
/// each triangle, in m. The JSON: {"type": "scene", "name", "objects": [names], "triangles": of the scene,
/// "parts":
/// [{"mover": 0 or 1 + index of what moves, in whose frame it is, "corners"}], "bounds": [[x, y, z], [x, y,
/// z]]}.
std::string scene_message(const Scene& scene, const std::string& name);

}  // namespace echoloop::view
