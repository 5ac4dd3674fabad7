// Ctrl-C and SIGTERM as a flag that loops look at. Ends nothing itself.
#pragma once

namespace echoloop::poses {

/// From now on these signals only raise the flag.
void catch_signals();
bool stopped();

}  // namespace echoloop::poses
