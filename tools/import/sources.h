// Copies of a world's SDF and URDF files in which every address is the path of a file that may be read.
// libsdformat sees these copies only: so it opens nothing that the user has not named, and its stack is safe
// from files that include themselves. What a sonar does not meet (collisions, sensors, plugins, lights) is
// left out of the copies.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tools/import/model_paths.h"
#include "tools/import/shape.h"

namespace echoloop::worlds {

/// In the copies, the address of the mesh that stands for Sources::drawn[N] is this and N.
inline constexpr const char* drawn_address = "echoloop_drawn_";

struct Sources {
    std::filesystem::path world;                   ///< copy of the world
    bool is_urdf = false;                          ///< one robot and nothing else
    std::map<std::string, std::string> originals;  ///< of each copy's folder
    std::vector<std::string> left_out;             ///< what could not be had, one line each
    std::vector<std::string> notes;                ///< what else somebody might miss
    std::vector<Shape> drawn;                      ///< of geometries that libsdformat does not read
};

/// Makes the copies in the folder `scratch`. Throws Fault for XML that is none, files that include
/// themselves, more than 20,000 included models, and, unless `allow_missing`, for what cannot be had: all of
/// it in one text, a line each.
Sources collect_sources(const std::filesystem::path& world, const ModelPaths& paths,
                        const std::filesystem::path& scratch, bool allow_missing);

}  // namespace echoloop::worlds
