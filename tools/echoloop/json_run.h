// The --json lines of `echoloop run`: one at the start, one at the end.
#pragma once

#include <string>
#include <vector>

#include "emulator/runtime.h"

namespace echoloop::cli {

std::string run_started_json(const Scenario& scenario, const Runtime& runtime);
std::string run_summary_json(const std::vector<SessionSummary>& sessions);

}  // namespace echoloop::cli
