// Seabeds with a typical angular response, by name. Knows no file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/scene/scene.h"

namespace echoloop {

/// Null when the name is not known. Names: known_seabeds().
const Material* seabed_by_name(std::string_view name);
std::vector<std::string> known_seabeds();

}  // namespace echoloop
