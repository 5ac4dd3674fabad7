// The `objects` of a scenario: things of the scene that move, and by what. Opens neither scene nor endpoint.
#pragma once

#include <vector>

#include "emulator/scenario/scenario.h"
#include "emulator/scenario/section.h"

namespace echoloop::scenario {

/// `value` is the list, or nullptr. The scenario's file and its vehicle's input are known already.
std::vector<ScenarioObject> read_objects(const Value* value, const Scenario& scenario, Problems& problems);

/// An endpoint that somebody outside can send poses to, "" if there is none. `path`: of the key, for
/// messages.
std::string read_pose_endpoint(const Section& section, std::string_view key, Problems& problems);

/// Whether two such endpoints, each "" if there is none, want the same port, line or standard input.
bool same_place(const std::string& a, const std::string& b);

/// A file of poses; empty if there is none.
std::filesystem::path read_trajectory_name(const Section& section, const std::filesystem::path& file,
                                           Problems& problems);

}  // namespace echoloop::scenario
