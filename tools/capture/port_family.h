// Which protocol family a port of a capture speaks, from its first bytes.
#pragma once

#include <map>

#include "protocols/inspect.h"
#include "tools/capture/ports.h"

namespace echoloop::capture {

/// `sides`: for each key whether the device is `first` there; its bytes count before its driver's. nullptr if
/// neither side speaks a known family. Reads no more of the capture than it takes to tell.
const inspect::Family* family_of_port(CaptureReader& capture, const std::map<PortKey, bool>& sides);

}  // namespace echoloop::capture
