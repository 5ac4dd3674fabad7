// Turns the bytes of a .gltf or .glb into a Scene. Reads other files only through the SceneFolder it is
// given.
#pragma once

#include <memory>
#include <span>

#include "render/scene/folder.h"
#include "render/scene/scene.h"

namespace echoloop {

/// Throws SceneFault for anything that is wrong with the bytes.
std::shared_ptr<const Scene> read_scene(SceneFolder::Bytes bytes, const SceneFolder& folder,
                                        const SceneOptions& options = {});

}  // namespace echoloop
