// Values as YAML again, so that what was read and changed can be shown and read anew.
#pragma once

#include <string>

#include "emulator/scenario/value.h"

namespace echoloop::scenario {

/// In one line: "{position: [0, 0, -2]}", as --set takes it.
std::string flow_text(const Value& value);
/// A document of several lines.
std::string block_text(const Value& value);

}  // namespace echoloop::scenario
