// Two captures compared: directions matched, messages paired, fields and times looked at.
#pragma once

#include "tools/echoloop/diff/report.h"
#include "tools/echoloop/diff/rules.h"

namespace echoloop::diff {

Report compare(const Side& a, const Side& b, const Rules& rules);

}  // namespace echoloop::diff
