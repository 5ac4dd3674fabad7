// The materials of a scene as its file declares them.
#pragma once

#include <algorithm>
#include <vector>

#include "render/scene/scene.h"

namespace echoloop {

/// Each once, though a scene tells its flat and its curved surfaces apart.
inline std::vector<Material> declared_materials(const Scene& scene) {
    std::vector<Material> out;
    for (Material material : scene.materials()) {
        material.mesh_slope = 0;
        if (std::ranges::find(out, material) == out.end()) out.push_back(material);
    }
    return out;
}

}  // namespace echoloop
