// What every pose program does around its middleware: command line, signals, errors with exit statuses, the
// summary. Knows no middleware.
#pragma once

#include <functional>
#include <string>

#include "tools/poses/common/feed.h"
#include "tools/poses/common/options.h"

namespace echoloop::poses {

/// Listens until stopped() and hands what it hears to the feed.
using Listen = void (*)(const Options&, Feed&);

/// Does the work of the program of this name and says what went wrong. The exit status of the process
/// (sysexits).
int exit_status(const std::string& name, const std::function<void()>& work);

/// The exit status of the process (sysexits).
int run_program(int argc, const char* const* argv, const Program& program, Listen listen);

/// One line that says where poses come from and go to, and how to end it.
void say_ready(const Options& options, const std::string& from);

}  // namespace echoloop::poses
