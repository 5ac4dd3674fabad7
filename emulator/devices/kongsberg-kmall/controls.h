// What a controller's texts 261 and 262 read and set: names of values, as two generations of K-Controller
// spell them, and what they mean to this sounder. Pure functions.
#pragma once

#include <string>
#include <string_view>

#include "emulator/devices/kongsberg-kmall/settings.h"

namespace echoloop::kongsberg_kmall {

/// m below the head, as set; before: what the outermost beam reaches at the range.
double max_depth(const Settings& settings);

/// One NAME=VALUE of a text 262, e.g. "RUNT_PARAM_PU_PING_MODE=5.00" or "STPF=5". False, and nothing is set,
/// if the name is not known or the value out of its bounds.
bool set_value(std::string_view assignment, Settings& settings);

/// All that can be set, as the text 401 has them: [{"id":"RUNT_PARAM_PU_PING_MODE","value":"5.00"}, ...].
std::string values_as_json(const Settings& settings);
/// The same as the text 814 has them: <ALL_TOKENS>, a TOKEN of ID and VALUE each, a line for each tag.
std::string values_as_xml(const Settings& settings);

}  // namespace echoloop::kongsberg_kmall
