// The program: runs the command line and turns every error into one message and an exit status of sysexits.
#include <cstdio>
#include <exception>
#include <new>

#include "emulator/contract/error.h"
#include "render/memory_check.h"
#include "tools/echoloop/command_line.h"
#include "tools/echoloop/log.h"
#include "tools/echoloop/terminal.h"

namespace {

int status(echoloop::Exit exit) { return static_cast<int>(exit); }

int run(int argc, char** argv) {
    using echoloop::cli::print_error;
    try {
        return echoloop::cli::run_command_line(argc, argv);
    } catch (const echoloop::StartError& error) {
        print_error(error.what());
        return status(error.exit());
    } catch (const echoloop::OutOfMemory& error) {
        print_error(error.what());
        return status(echoloop::Exit::os_error);
    } catch (const std::bad_alloc&) {
        print_error("not enough memory; end other programs, or raise this process' limit (ulimit -v)");
        return status(echoloop::Exit::os_error);
    } catch (const std::exception& error) {
        print_error(std::string("internal: ") + error.what());
        return status(echoloop::Exit::software);
    }
}

}  // namespace

int main(int argc, char** argv) {
    // Standard output is for what was asked for.
    echoloop::cli::log_to_stderr();
    const int result = run(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        echoloop::cli::print_error("cannot write to standard output");
        return status(echoloop::Exit::io);
    }
    return result;
}
