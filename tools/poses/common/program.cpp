#include "tools/poses/common/program.h"

#include <exception>

#include "emulator/contract/error.h"
#include "tools/poses/common/say.h"
#include "tools/poses/common/stop.h"

namespace echoloop::poses {

int exit_status(const std::string& name, const std::function<void()>& work) {
    name_program(name);
    try {
        work();
        return static_cast<int>(Exit::ok);
    } catch (const StartError& error) {
        say(error.what());
        return static_cast<int>(error.exit());
    } catch (const std::exception& error) {
        say(std::string("internal: ") + error.what());
        return static_cast<int>(Exit::software);
    }
}

int run_program(int argc, const char* const* argv, const Program& program, Listen listen) {
    return exit_status(program.name, [&] {
        const auto options = read_options(argc, argv, program);
        if (!options) return;
        catch_signals();
        Sender sender(options->to);
        Feed feed(*options, sender);
        listen(*options, feed);
        feed.print_summary();
    });
}

void say_ready(const Options& options, const std::string& from) {
    std::string topics;
    for (const auto& topic : topics_of(options)) topics += (topics.empty() ? "" : ", ") + topic;
    say(topics + " from " + from + " to " + to_string(options.to) + (options.step ? ", stepping" : "") +
        "; Ctrl-C ends");
}

}  // namespace echoloop::poses
