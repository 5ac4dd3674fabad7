// A capture as a bag (docs/bags.md): its messages with their fields, and the pictures and soundings in them.
#pragma once

#include "tools/echoloop/convert/from_capture.h"

namespace echoloop::convert {

/// A row for each message. Throws StartError (data) if there is none of a known protocol.
Written write_bag(const Source& source, const std::filesystem::path& out);

}  // namespace echoloop::convert
