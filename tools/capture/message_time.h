// When a message was said, by what it says itself. Knows fields by their names.
#pragma once

#include <optional>

#include "protocols/inspect.h"

namespace echoloop::capture {

/// s, since 1970 or since the device's power-up; empty if the message holds no time that can be one.
std::optional<double> message_time(const inspect::Message& message);

}  // namespace echoloop::capture
