// Any file of captured traffic, whoever wrote it: the one place that knows all their readers.
#pragma once

#include <string>
#include <vector>

#include "tools/capture/capture.h"

namespace echoloop::capture {

struct OpenSettings {
    double interval = 0;   ///< s between messages of a file that holds no times; 0: by its times
    bool as_sent = false;  ///< messages are cut into the parts and packets that the device sends; what only
                           ///< files hold is left out
};

/// pcap, pcapng, a maker's recording, a serial log as text, or messages back to back. `input` outlives it.
/// Times never go back (steady.h). Throws StartError (data) if it is none of them.
std::unique_ptr<CaptureReader> open_capture(Input& input, const OpenSettings& settings = {});

/// The same for files that hold more than a device's messages back to back; nullptr for those.
std::unique_ptr<CaptureReader> open_if_log(Input& input);

/// What went wrong while it was read, one sentence each; empty if nothing did.
std::vector<std::string> troubles(const CaptureCounts& counts);

}  // namespace echoloop::capture
