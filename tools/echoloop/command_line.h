// The command line against the table of verbs. The only user of CLI11.
#pragma once

namespace echoloop::cli {

/// Parses, runs the verb and returns the exit status (sysexits). Prints help and usage errors; throws what
/// the verb throws.
int run_command_line(int argc, const char* const* argv);

}  // namespace echoloop::cli
