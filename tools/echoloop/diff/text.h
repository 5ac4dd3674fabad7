// A comparison of two captures for people. Prints what it is given.
#pragma once

#include "tools/echoloop/diff/report.h"

namespace echoloop::diff {

/// `everything`: fields that are equal, too.
void print(const Report& report, bool everything);

}  // namespace echoloop::diff
