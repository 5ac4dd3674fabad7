// What `echoloop replay` says to a person.
#pragma once

#include <vector>

#include "emulator/replay/replay.h"
#include "tools/echoloop/replay_ports.h"

namespace echoloop::cli {

enum class ReplayMode { timed, stepped, answering };

/// Warnings on stderr.
void warn_of_what_is_not_played(const capture::Survey& survey);

void print_replay_start(ReplayMode mode, const std::vector<Assignment>& assignments,
                        const replay::Replay& replay);
void print_replay_end(ReplayMode mode, const replay::Summary& summary, const replay::PlayerCounts& counts);

}  // namespace echoloop::cli
