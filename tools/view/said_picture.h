// A picture that was read back from the wire, made small enough for a page. Opens nothing.
#pragma once

#include <string>

#include "tools/said/said.h"

namespace echoloop::view {

/// A message of the form of picture.h, of type "said": levels as there, in dB or counts, and where the JSON
/// says so then a range (f32, little endian, m; 0: none) for each beam. `number`: of the picture.
std::string message_of(const said::Picture& picture, const std::string& device, std::uint64_t number,
                       double unix_time);

}  // namespace echoloop::view
