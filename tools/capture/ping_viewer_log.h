// The sensor logs of Ping Viewer, .bin: the frames that it received, with their times. Texts are UTF-16, or
// UTF-8 in logs that its script re-encoded. Takes any bytes.
#pragma once

#include "tools/capture/open.h"

namespace echoloop::capture {

/// nullptr if it is none. Throws StartError (data) if its header cannot be read.
std::unique_ptr<CaptureReader> open_ping_viewer_log(Input& input, const OpenSettings& settings);

}  // namespace echoloop::capture
