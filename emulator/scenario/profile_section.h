// Profiles of devices: the complete file of a model, and the numbers that a scenario puts over it. Strict:
// what is unknown, missing or out of range is a problem with its place.
#pragma once

#include <string>

#include "emulator/contract/model.h"
#include "emulator/scenario/section.h"

namespace echoloop::scenario {

/// The profile that `text`, the content of `file`, holds for `model`.
Profile read_profile(const std::string& text, const std::string& file, const Model& model,
                     Problems& problems);

/// Puts the figures of `value`, {name: value}, over those of `profile`.
void read_figures(const Value* value, const std::string& path, const Model& model, Profile& profile,
                  Problems& problems);

/// Adds a problem at `place`, by the name `path`, where one axis alone is a piston's, or both but not of one
/// width.
void check_piston(const Profile& profile, const Place& place, const std::string& path, Problems& problems);

}  // namespace echoloop::scenario

namespace echoloop {

/// The model's own profile, as it was built into the program. Throws ScenarioError.
Profile own_profile(const Model& model);

}  // namespace echoloop
