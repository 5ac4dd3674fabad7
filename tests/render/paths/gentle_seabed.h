// A seabed that stand-ins follow closely.
#pragma once

#include "tests/render/meshes.h"

namespace echoloop::test {

/// seabed(), a quarter as high.
inline Mesh gentle_seabed(int cells) {
    constexpr double share = 0.25;
    Mesh mesh = seabed(cells);
    for (Vec3& p : mesh.positions) p.z = -6 + share * (p.z + 6);
    for (Vec3& n : mesh.normals) n = {share * n.x, share * n.y, n.z};
    return mesh;
}

}  // namespace echoloop::test
