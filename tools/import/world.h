// A world on its way into a scene file: meshes, nodes and materials, in ENU metres with z up. Plain data;
// knows no file format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/pose.h"

namespace echoloop::worlds {

/// What the scene reader makes an acoustic material of (render/README.md, Scenes): its name, and the keys of
/// `extras.sonar`, as far as they are given.
struct Material {
    std::string name{};
    std::string acoustic{};  ///< `material`: a name of the reader's table; empty: not given
    std::string seabed{};    ///< `seabed`; empty: not given
    std::vector<std::pair<std::string, double>> figures{};  ///< `mu_db`, `reflection` and so on
    bool double_sided = false;
    friend bool operator==(const Material&, const Material&) = default;
};

/// Triangles of one material, counter-clockwise seen from outside.
struct Surface {
    std::vector<Vec3> positions{};         ///< m, in the node's frame
    std::vector<std::uint32_t> indices{};  ///< three per triangle
    std::size_t material = 0;              ///< in World::materials
};

struct Mesh {
    std::string name{};
    std::vector<Surface> surfaces{};
};

struct Node {
    std::string name{};                   ///< identifies the object in a run's truth
    Pose pose{};                          ///< in the frame of the node above, or of the world
    std::optional<std::size_t> mesh{};    ///< in World::meshes; several nodes may share one
    std::vector<std::size_t> children{};  ///< in World::nodes
};

/// Where the world's origin lies on the Earth: WGS 84, degrees, and metres above the level that z counts
/// from.
struct Origin {
    double latitude = 0, longitude = 0, height = 0;
};

struct World {
    std::vector<Material> materials{};
    std::vector<Mesh> meshes{};
    std::vector<Node> nodes{};
    std::vector<std::size_t> roots{};  ///< nodes below no other
    std::optional<Origin> origin{};
};

}  // namespace echoloop::worlds
