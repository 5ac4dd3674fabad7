// Seconds as labels and answers tell them; never those that anything is computed with.
#pragma once

#include "emulator/contract/device.h"

namespace echoloop {

/// s, the number nearest to the nanoseconds: 60 s are 60, where a product with 1e-9 makes 60.00000000000001.
inline double told_seconds(Time t) { return static_cast<double>(t.count()) / 1e9; }

}  // namespace echoloop
