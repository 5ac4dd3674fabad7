// The largest block that the test program asked operator new for. Counts, never limits.
#pragma once

#include <cstddef>

namespace echoloop {

/// In bytes, since a test set it to 0.
extern std::size_t largest_allocation;

}  // namespace echoloop
