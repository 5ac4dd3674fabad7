// Meshes of .dae, .obj, .stl, .ply, .gltf and .glb files, read by assimp as Gazebo reads them: Collada's
// <unit> counts, its <up_axis> does not, and glTF's y stays y.
#pragma once

#include <filesystem>
#include <string>

#include "tools/import/model_paths.h"
#include "tools/import/shape.h"

namespace echoloop::worlds {

struct MeshChoice {
    std::string submesh{};  ///< only the parts of this name; empty: all
    bool center = false;    ///< move the submesh's middle to the origin
    Vec3 scale{1, 1, 1};
};

/// Opens the file and, of those that it names, only what `paths` holds. Throws Fault for a file that is no
/// mesh, has none of that name, or numbers that are not finite.
Shape read_mesh(const std::filesystem::path& file, const MeshChoice& choice, const ModelPaths& paths);

}  // namespace echoloop::worlds
