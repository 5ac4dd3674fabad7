// What a driver says to a sonar to get pings out of it. Bytes only; it sends nothing.
#pragma once

#include <vector>

#include "emulator/scenario/scenario.h"

namespace echoloop::cli {

/// The words for pings, one after the other: each makes one, an empty one stands for a sonar that goes on by
/// itself. Nothing for models that ping unasked, or want a longer talk. `turns`: the last ping is a step of
/// the motor away from the one before.
std::vector<Bytes> requests_of(const ScenarioDevice& device, bool turns);

}  // namespace echoloop::cli
