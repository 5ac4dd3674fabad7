// The recordings of KMALL systems, R2Sonic in XTF, Oculus and ARIS: what each looks like. One function to
// know it by its first bytes and open it.
#pragma once

#include "tools/capture/container.h"
#include "tools/capture/open.h"

namespace echoloop::capture {

/// .kmall and .kmwcd: datagrams back to back.
std::unique_ptr<CaptureReader> open_kmall(Input& input, const OpenSettings& settings);
/// .oculus of the maker's program: messages in items with their times. Throws StartError (data) if it is
/// encrypted.
std::unique_ptr<CaptureReader> open_oculus(Input& input, const OpenSettings& settings);
/// .aris: frames, given out as the parts that carry them. One part each unless the device's own are asked
/// for.
std::unique_ptr<CaptureReader> open_aris(Input& input, const OpenSettings& settings);
/// .xtf: of R2Sonic sounders, as QINSy and Triton write them, or of side-scans, as messages of JSF. What
/// other instruments said is passed over.
std::unique_ptr<CaptureReader> open_xtf(Input& input, const OpenSettings& settings);

}  // namespace echoloop::capture
