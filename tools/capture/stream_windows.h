// Decodes a long run of bytes piece by piece in bounded memory, with the same messages as all at once.
#pragma once

#include <functional>

#include "protocols/inspect.h"
#include "tools/capture/capture.h"

namespace echoloop::capture {

/// Calls `each` for every message and undecoded span, in order, with offsets from the start of the input.
/// Undecoded spans that touch are one. Returns the number of bytes.
std::size_t decode_windows(Input& input, const inspect::Family& family,
                           const std::function<void(const inspect::Message&)>& each);

}  // namespace echoloop::capture
