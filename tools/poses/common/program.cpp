#include "tools/poses/common/program.h"

#include <exception>

#include "emulator/contract/error.h"
#include "tools/poses/common/say.h"
#include "tools/poses/common/stop.h"

namespace echoloop::poses {

int run_program(int argc, const char* const* argv, const Program& program, Listen listen) {
    name_program(program.name);
    try {
        const auto options = read_options(argc, argv, program);
        if (!options) return static_cast<int>(Exit::ok);
        catch_signals();
        Sender sender(options->to);
        Feed feed(*options, sender);
        listen(*options, feed);
        feed.print_summary();
        return static_cast<int>(Exit::ok);
    } catch (const StartError& error) {
        say(error.what());
        return static_cast<int>(error.exit());
    } catch (const std::exception& error) {
        say(std::string("internal: ") + error.what());
        return static_cast<int>(Exit::software);
    }
}

void say_ready(const Options& options, const std::string& from) {
    std::string topics;
    for (const auto& topic : topics_of(options)) topics += (topics.empty() ? "" : ", ") + topic;
    say(topics + " from " + from + " to " + to_string(options.to) + (options.step ? ", stepping" : "") +
        "; Ctrl-C ends");
}

}  // namespace echoloop::poses
