// What a run ends with, as text: how late its pings were and why, what crossed the wires, where poses came
// from. Measures nothing.
#pragma once

#include <string>
#include <vector>

#include "emulator/pose/input.h"
#include "emulator/pose/step_server.h"
#include "emulator/run/runtime.h"

namespace echoloop::cli {

/// A few lines for each sonar; of several, a line for all of them.
void print_summary(const std::vector<SessionSummary>& sessions);

/// Throws StartError if a ping was late, or messages or bytes were lost.
void demand_punctuality(const std::vector<SessionSummary>& sessions);

/// `untold`: what became of it if nobody said where it is.
void print_poses(const std::string& name, const PoseSummary& poses, const char* untold);
void print_steps(const StepSummary& steps);
/// What the host of a virtual machine took, in seconds of processor time; nothing if it took none.
void print_stolen(double seconds);

}  // namespace echoloop::cli
