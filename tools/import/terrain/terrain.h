// Adds a survey of the bottom to a world, as triangles.
#pragma once

#include <functional>

#include "tools/import/terrain/survey.h"
#include "tools/import/world.h"

namespace echoloop::worlds {

struct TerrainOptions {
    SurveyOptions survey{};
    std::optional<Origin> origin{};      ///< of the world, where it has none yet
    double error = 0.1;                  ///< m, of any sample, up or down
    std::size_t triangles = 1'000'000;   ///< at most
    std::function<void(double)> told{};  ///< now and then: which share of the triangles is made, about
    std::string material = "sand";       ///< a name of the scene reader's table, or one of its seabeds
};

/// A node that is called as the file is, without its ending. Gives the world an origin if it has none.
/// Returns what was taken and what was guessed. Throws Fault; the world is then as it was.
std::vector<std::string> add_terrain(World& world, const std::filesystem::path& file,
                                     const TerrainOptions& options);

}  // namespace echoloop::worlds
