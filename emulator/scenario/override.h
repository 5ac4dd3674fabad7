// --set path=value: changes the tree of a scenario before it is checked. Knows no meaning of any key.
#pragma once

#include <string>
#include <vector>

#include "emulator/scenario/problems.h"
#include "emulator/scenario/value.h"

namespace echoloop::scenario {

/// Applies each "path=value" to `root` in order; the value is YAML ("50", "[0, 0, -3]", "{a: 1}").
/// A path is keys joined by dots; an element of a list is meant by its `name` or by its number from 0.
/// Maps that are missing on the way are made. What cannot be applied becomes a problem.
void apply_overrides(Value& root, const std::vector<std::string>& set_arguments, Problems& problems);

}  // namespace echoloop::scenario
