// When messages come, as statistics. Compares nothing.
#pragma once

#include "tools/echoloop/diff/report.h"

namespace echoloop::diff {

/// Between each message and the next.
Statistics gaps(const std::vector<Message>& messages);

/// From each message of type `name` to the first that the other side says before the next one of this side.
Statistics answer_delays(const Direction& asking, const Direction& answering, const std::string& name);

}  // namespace echoloop::diff
