// The --json documents of `echoloop replay` and `echoloop record`.
#pragma once

#include <string>
#include <vector>

#include "emulator/capture/recording.h"
#include "emulator/replay/relay.h"
#include "emulator/replay/replay.h"
#include "tools/echoloop/replay_ports.h"

namespace echoloop::cli {

/// {"ports": [{"name", "kind", "device": {"pieces", "bytes"}, "driver": {...}, "begin", "end"}], "skipped"}
std::string ports_json(const capture::Survey& survey);

/// One line: {"event": "started", "ports": [{"name", "place"}]}, and "view", the page's link, where it is
/// one.
std::string replay_started_json(const std::vector<Assignment>& assignments, const replay::Replay& replay,
                                const std::string& view);

/// One line: {"event": "ended", "messages", "bytes", ...}
std::string replay_summary_json(const replay::Summary& summary, const replay::PlayerCounts& counts);

/// One line each, as above: {"event": "started", "device", "driver"}; {"event": "ended", "from_device", ...}
std::string relay_started_json(const replay::Relay& relay);
std::string relay_summary_json(const replay::RelaySummary& passed, const RecordingSummary& recorded);

}  // namespace echoloop::cli
