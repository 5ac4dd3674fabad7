// How much processor time the host of a virtual machine has taken: "steal" of /proc/stat.
#pragma once

namespace echoloop {

/// s, of all processors together since the machine started; 0 on a machine of its own, or where it is
/// unknown.
double stolen_seconds();

}  // namespace echoloop
