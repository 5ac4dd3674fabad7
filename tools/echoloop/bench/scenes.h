// The scenes of `echoloop bench`, made in memory so that it runs anywhere: boxes, a ball and four walls on a
// square of seabed. The same geometry as tools/scenes/bench.py; reads no file.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "render/scene/scene.h"

namespace echoloop::bench {

struct SceneRow {
    std::string_view name;
    int cells = 1;         ///< of the seabed, per side
    double amplitude = 0;  ///< m, of its waves
    enum class Kind { two_meshes, one_mesh, terrain, stones } kind = Kind::two_meshes;
};

/// simple: 1,158 triangles; big100k: 101,508; one1m: 1,000,854; big2m and one2m: 2,001,156; terrain: 980,000,
/// which is nothing but hills and ripples; stones: 451,516, of which 350,008 are a thousand small objects on
/// that of big100k.
std::span<const SceneRow> scene_rows();

/// In ENU: the seabed and the objects as two meshes or one, or a mesh and many more. Throws
/// std::invalid_argument for a name that is not in scene_rows().
std::vector<Mesh> scene_meshes(std::string_view name);

}  // namespace echoloop::bench
