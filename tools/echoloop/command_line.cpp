#include "tools/echoloop/command_line.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "emulator/contract/error.h"
#include "emulator/scenario/problems.h"
#include "tools/echoloop/verb.h"

namespace echoloop::cli {
namespace {

constexpr auto purpose =
    "echoloop: a sonar for your driver to talk to. It renders a 3D scene, turns it into echoes and sends "
    "them in\n"
    "the sonar's own protocol on serial ports, pseudo-terminals, TCP and UDP.";

constexpr auto first_steps =
    "Examples:\n"
    "  echoloop run demo                          start the emulator with an example, until Ctrl-C\n"
    "  echoloop endpoints demo                    what to write into your driver's configuration\n"
    "  echoloop VERB --help                       arguments and examples of a verb";

using Given = std::map<std::string, std::vector<std::string>, std::less<>>;

CLI::Option* add(CLI::App& app, const Argument& argument, Given& given) {
    using Kind = Argument::Kind;
    if (argument.kind == Kind::flag)
        return app.add_flag_callback(
            argument.name, [&given, name = argument.name] { given[name] = {}; }, argument.help);
    const auto keep = [&given, name = argument.name](const std::vector<std::string>& values) {
        given[name] = values;
        return true;
    };
    CLI::Option* option = app.add_option(argument.name, keep, argument.help);
    option->type_name(argument.what)->expected(1)->required(argument.required);
    if (argument.kind == Kind::repeated) option->expected(1, 1000)->take_all()->allow_extra_args(false);
    if (argument.kind == Kind::words) option->expected(1, 1000)->take_all()->allow_extra_args();
    if (!argument.choices.empty()) option->check(CLI::IsMember(argument.choices));
    return option;
}

CLI::App* add(CLI::App& app, const Verb& verb, Given& given) {
    CLI::App* sub = app.add_subcommand(verb.name, verb.summary);
    for (const auto& argument : verb.arguments) add(*sub, argument, given);
    sub->group(verb.hidden ? "" : "Verbs");
    sub->footer("Examples:\n" + verb.examples);
    return sub;
}

void refuse_unknown_verb(int argc, const char* const* argv) {
    if (argc < 2) throw StartError(Exit::usage, "which verb? see echoloop --help");
    if (argv[1][0] == '-') return;
    std::vector<std::string_view> known;
    for (const auto& verb : verbs()) known.push_back(verb.name);
    if (std::find(known.begin(), known.end(), argv[1]) != known.end()) return;
    throw StartError(Exit::usage,
                     "unknown verb " + scenario::in_quotes(argv[1]) + scenario::suggestion(argv[1], known));
}

/// "--durtion" of run is meant for "--duration": the parser itself only says that it was not expected.
void refuse_unknown_options(int argc, const char* const* argv) {
    const auto verb =
        std::find_if(verbs().begin(), verbs().end(), [&](const Verb& v) { return v.name == argv[1]; });
    if (verb == verbs().end()) return;
    std::vector<std::string_view> known{"--help"};
    for (const auto& argument : verb->arguments)
        if (argument.name.starts_with("--")) known.push_back(argument.name);
    for (int i = 2; i < argc; ++i) {
        const auto word = std::string_view(argv[i]).substr(0, std::string_view(argv[i]).find('='));
        if (word == "--") return;
        if (!word.starts_with("--") || std::find(known.begin(), known.end(), word) != known.end()) continue;
        throw StartError(Exit::usage, "unknown option " + scenario::in_quotes(word) + " of " + verb->name +
                                          scenario::suggestion(word, known) + "; see echoloop " + verb->name +
                                          " --help");
    }
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
    refuse_unknown_verb(argc, argv);
    refuse_unknown_options(argc, argv);
    CLI::App app(purpose, "echoloop");
    app.get_formatter()->column_width(36);
    app.get_formatter()->label("SUBCOMMAND", "VERB");
    app.set_version_flag("--version", "echoloop " ECHOLOOP_VERSION);
    app.require_subcommand(1);
    app.footer(first_steps);
    Given given;
    std::vector<std::pair<CLI::App*, const Verb*>> subs;
    for (const auto& verb : verbs()) subs.emplace_back(add(app, verb, given), &verb);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
        const auto used = app.get_subcommands();
        const auto help = "echoloop " + (used.empty() ? "" : used.front()->get_name() + " ") + "--help";
        throw StartError(Exit::usage, std::string(error.what()) + "; see " + help);
    }
    for (const auto& [sub, verb] : subs)
        if (sub->parsed()) return verb->run(Arguments(given));
    return static_cast<int>(Exit::usage);
}

}  // namespace echoloop::cli
