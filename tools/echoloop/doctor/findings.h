// What `echoloop doctor` looks at: this machine, its graphics, its lines, and one scenario on it. Leaves
// everything as it was.
#pragma once

#include <string>
#include <vector>

#include "emulator/scenario/scenario.h"

namespace echoloop::cli {

struct Finding {
    enum class State {
        good,
        weak,  ///< works, but somebody may wonder later
        bad,   ///< something will not work
    };
    State state = State::good;
    std::string name;    ///< "timers"
    std::string text;    ///< what was seen
    std::string remedy;  ///< "": none needed
};
using Findings = std::vector<Finding>;

/// Processors, memory, how late timers ring, open files, receive buffers.
Findings look_at_machine();
/// Which OpenGL contexts can be had, and which one `auto` takes.
Findings look_at_graphics();
/// Pseudo-terminals, their links, serial ports, sockets.
Findings look_at_lines();
/// Whether everything of the scenario can be opened, and each device's time for a ping against what it has.
Findings look_at_scenario(const Scenario& scenario);

}  // namespace echoloop::cli
