// What a run ends with, as text: how late its pings were and why, what crossed the wires, where poses came
// from. Measures nothing.
#pragma once

#include <string>
#include <vector>

#include "emulator/pose/input.h"
#include "emulator/run/runtime.h"
#include "emulator/machine/standstills.h"
#include "emulator/run/step_server.h"

namespace echoloop::cli {

/// A few lines for each sonar; of several, a line for all of them.
void print_summary(const std::vector<SessionSummary>& sessions);

/// Throws StartError if a ping was late, or messages or bytes were lost. Pings that the machine held up are not late.
void demand_punctuality(const std::vector<SessionSummary>& sessions);

/// `untold`: what became of it if nobody said where it is.
void print_poses(const std::string& name, const PoseSummary& poses, const char* untold);
void print_steps(const StepSummary& steps);
void print_standstills(const Standstills::Summary& standstills);

}  // namespace echoloop::cli
