// What the control socket answers, as lines of JSON. Words only; does nothing.
#pragma once

#include <string>
#include <vector>

#include "emulator/faults/faults.h"
#include "emulator/run/session.h"
#include "emulator/water/render_threads.h"

namespace echoloop::answers {

/// {"ok": false, "error": "..."}
std::string refusal(const std::string& reason);
/// {"ok": true}
std::string welcome();
/// {"ok": true, "id": 3}
std::string added(int id);
/// {"ok": true, "cleared": 1}
std::string cleared(std::size_t count);
/// {"ok": true, "t": 12.5, "faults": [{"id": 3, "device": ..., "kind": ..., "on": true, "made": 17}]}
std::string list(const Faults& faults, Time now);
/// {"ok": true, "t": 12.5, "devices": [{"name": ..., counters, "faults": {"loss": 3}}]}
std::string status(const std::vector<SessionSummary>& sessions, RenderThreads::Load rendering,
                   const Faults& faults, Time now);

}  // namespace echoloop::answers
