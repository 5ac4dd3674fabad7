// Any file of captured traffic, whoever wrote it: the one place that knows all their readers.
#pragma once

#include <functional>

#include "tools/capture/capture.h"

namespace echoloop::capture {

struct OpenSettings {
    double interval = 0;  ///< s between messages of a file that holds no times; 0: by its times
};

/// pcap, pcapng, a log of Ping Viewer, a serial log as text, or messages back to back. `input` outlives it.
/// Times never go back (steady.h). Throws StartError (data) if it is none of them.
std::unique_ptr<CaptureReader> open_capture(Input& input, const OpenSettings& settings = {});

/// True for files that hold times and directions, not only a device's messages.
bool is_log(Input& input);

/// What to do with events; times in s since 1970.
struct CaptureEvents {
    std::function<void(double, const Datagram&)> datagram;
    std::function<void(double, const StreamPiece&)> stream;
};

/// Reads all of it. Throws StartError (data) if it is none that can be read.
CaptureCounts read_capture(Input& input, const CaptureEvents& events);

}  // namespace echoloop::capture
