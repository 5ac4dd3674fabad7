// A comparison of two captures as JSON, for scripts.
#pragma once

#include "tools/echoloop/diff/report.h"

namespace echoloop::diff {

/// {"equal", "a": {"file", "messages"}, "b", "directions": [{"family", "a", "b", "types": [{"name", "a", "b",
/// "fields", ...}]}], "warnings"}; a field's "a" and "b" are its distributions; places are {"packet", "time",
/// "message"}, times in s.
std::string report_json(const Report& report);

}  // namespace echoloop::diff
