// What the command line says of surveys, checked.
#pragma once

#include <functional>
#include <string>

#include "tools/import/terrain/terrain.h"

namespace echoloop::worlds {

/// Whether a file's ending is that of a survey.
bool is_survey(const std::filesystem::path& file);

/// `text` gives an option's value, or "" where it is not given; `flag` says whether it is. Throws StartError
/// (usage) with the option, the fault and an example.
TerrainOptions terrain_options(const std::function<std::string(const char*)>& text,
                               const std::function<bool(const char*)>& flag);

}  // namespace echoloop::worlds
