// The log on stderr, which never waits for its reader: what a pipe that nobody reads, or a terminal that
// stands, does not take is left out, and counted in the next line that it takes. Of lines that differ in
// numbers only it takes ten in ten seconds.
#pragma once

namespace echoloop::cli {

/// Lets spdlog write there. Colours only on a terminal.
void log_to_stderr();

}  // namespace echoloop::cli
