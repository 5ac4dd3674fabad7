// Which models speak a protocol with checksums, and what damages one. A table; knows no message.
#pragma once

#include <string_view>

namespace echoloop {

/// The family as protocols/checksums.h knows it; "" if the model's messages have no checksum.
std::string_view checksum_family(std::string_view model);

}  // namespace echoloop
