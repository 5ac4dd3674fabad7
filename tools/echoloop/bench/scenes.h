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
    bool one_mesh = false;
};

/// simple: 1,158 triangles; big100k: 101,508; big2m and one2m: 2,001,156.
std::span<const SceneRow> scene_rows();

/// The seabed and the objects, in ENU, as two meshes or one. Throws std::invalid_argument for a name that is
/// not in scene_rows().
std::vector<Mesh> scene_meshes(std::string_view name);

}  // namespace echoloop::bench
