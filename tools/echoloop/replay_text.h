// What `echoloop replay` says to a person.
#pragma once

#include <string>
#include <vector>

#include "emulator/replay/replay.h"
#include "tools/echoloop/replay_ports.h"

namespace echoloop::cli {

enum class ReplayMode { timed, stepped, answering };

/// Warnings on stderr.
void warn_of_what_is_not_played(const capture::Survey& survey);

/// `view`: link of the page; "" where there is none.
void print_replay_start(ReplayMode mode, const std::vector<Assignment>& assignments,
                        const replay::Replay& replay, const std::string& view);
void print_replay_end(ReplayMode mode, const replay::Summary& summary, const replay::PlayerCounts& counts);

}  // namespace echoloop::cli
