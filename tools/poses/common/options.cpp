#include "tools/poses/common/options.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <stdexcept>

#include "emulator/contract/error.h"

namespace echoloop::poses {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& why) {
    throw StartError(Exit::usage, option + " '" + text + "': " + why);
}

Source source(const std::string& option, const std::string& text, std::string object) {
    const auto hash = text.find('#');
    const auto topic = text.substr(0, hash);
    if (topic.empty()) refuse(option, text, "the topic is missing; write it as in /odom or /tf#base_link");
    return {topic, hash == std::string::npos ? "" : text.substr(hash + 1), std::move(object)};
}

std::pair<std::string, std::string> named(const std::string& option, const std::string& text,
                                          const std::string& example) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        refuse(option, text, "write it as in " + example);
    return {text.substr(0, equals), text.substr(equals + 1)};
}

Endpoint destination(const std::string& text) {
    try {
        const Endpoint endpoint = parse_endpoint(text);
        const bool network =
            endpoint.scheme == Endpoint::Scheme::udp || endpoint.scheme == Endpoint::Scheme::tcp;
        if (network && endpoint.port != 0) return endpoint;
    } catch (const std::invalid_argument& error) {
        throw StartError(Exit::usage, std::string("--to: ") + error.what());
    }
    refuse("--to", text,
           "write udp:// or tcp:// with the address that the scenario's vehicle.input listens at, "
           "as in udp://127.0.0.1:9500");
}

/// What CLI11 fills in before it is looked at.
struct Words {
    std::string to = "udp://127.0.0.1:9500", topic, frame = "enu";
    std::vector<std::string> objects, types;
    double zero = 0;
};

CLI::Option* add_arguments(CLI::App& app, const Program& program, Words& words, Options& options) {
    const auto repeated = [](CLI::Option* option) {
        option->expected(1, 1000)->take_all()->allow_extra_args(false);
    };
    app.add_option("--topic", words.topic, "where the vehicle's pose is published")
        ->type_name("TOPIC[#NAME]");
    repeated(
        app.add_option("--object", words.objects, "a node of the scene that moves, and its topic; repeatable")
            ->type_name("NODE=TOPIC[#NAME]"));
    app.add_option("--to", words.to, "the scenario's vehicle.input (default " + words.to + ")")
        ->type_name("ENDPOINT");
    app.add_option("--frame", words.frame, "axes of the poses: enu (and FLU) or ned (and FRD); default enu")
        ->type_name("enu|ned")
        ->check(CLI::IsMember({"enu", "ned"}));
    app.add_flag("--step", options.step,
                 "step the emulator's clock to the stamp of each pose of the vehicle");
    auto* zero = app.add_option("--zero", words.zero,
                                "the stamp that is second 0 of a stepped run (default: the first)")
                     ->type_name("SECONDS")
                     ->check(CLI::Range(0.0, 9e9));
    app.add_option("--clock", options.clock, program.clock_help)->type_name("TOPIC");
    app.add_option("--answer", options.answer,
                   "with --step: topic on which the stamp is published that the emulator has got to")
        ->type_name("TOPIC");
    if (program.transforms)
        app.add_option("--world", options.world, "root frame of transforms (default " + options.world + ")")
            ->type_name("FRAME");
    if (program.server) {
        options.server = "ws://127.0.0.1:9090";
        app.add_option("--server", options.server, "rosbridge's address (default " + options.server + ")")
            ->type_name("URL");
    }
    if (program.types)
        repeated(
            app.add_option("--type", words.types, "type of a topic that nobody publishes yet; repeatable")
                ->type_name("TOPIC=TYPE"));
    return zero;
}

void understand(const Words& words, Options& options) {
    options.to = destination(words.to);
    options.ned = words.frame == "ned";
    if (!words.topic.empty()) options.sources.push_back(source("--topic", words.topic, ""));
    for (const auto& text : words.objects) {
        const auto [node, topic] = named("--object", text, "ball=/ball/pose");
        options.sources.push_back(source("--object", topic, node));
    }
    for (const auto& text : words.types)
        options.types.push_back(named("--type", text, "/odom=nav_msgs/msg/Odometry"));
    if (options.sources.empty())
        throw StartError(Exit::usage,
                         "which topic? give --topic for the vehicle, or --object for a node of the scene");
    for (const auto& [option, topic] : {std::pair("--clock", options.clock), {"--answer", options.answer}})
        if (!topic.empty() && !options.step)
            throw StartError(Exit::usage, std::string(option) + " belongs to steps, so give --step as well");
}

}  // namespace

std::optional<Options> read_options(int argc, const char* const* argv, const Program& program) {
    CLI::App app(program.purpose, program.name);
    app.get_formatter()->column_width(36);
    app.set_version_flag("--version", program.name + " " ECHOLOOP_VERSION);
    app.footer("Examples:\n" + program.examples);
    Words words;
    Options options;
    const auto* zero = add_arguments(app, program, words, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::Success))
            throw StartError(Exit::usage, std::string(error.what()) + "; see " + program.name + " --help");
        app.exit(error);
        return {};
    }
    if (zero->count() > 0) options.zero = static_cast<Nanoseconds>(words.zero * 1e9);
    understand(words, options);
    return options;
}

std::vector<std::string> topics_of(const Options& options) {
    std::vector<std::string> topics;
    topics.reserve(options.sources.size());
    for (const auto& source : options.sources)
        if (std::find(topics.begin(), topics.end(), source.topic) == topics.end())
            topics.push_back(source.topic);
    return topics;
}

}  // namespace echoloop::poses
