// When messages come, as statistics. Compares nothing.
#pragma once

#include "tools/echoloop/diff/report.h"

namespace echoloop::diff {

/// s between each message and the next, as captured.
Spread gaps(const std::vector<Message>& messages);
/// s between each message and the next, by the times that they hold; of none if one holds none.
Spread own_gaps(const std::vector<Message>& messages);

/// s from each message of type `name` to the first that the other side says before the next one of this side.
Spread answer_delays(const Direction& asking, const Direction& answering, const std::string& name);

}  // namespace echoloop::diff
