// echoloop manual: the manual page and the completions, for the makers of packages.
#include "tools/echoloop/manual/manual.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace echoloop::cli {
namespace manual {

std::vector<const Verb*> shown_verbs() {
    std::vector<const Verb*> shown;
    for (const Verb& verb : verbs())
        if (!verb.hidden) shown.push_back(&verb);
    return shown;
}

bool is_option(const Argument& argument) { return argument.name.starts_with("--"); }

bool is_scenario(const Argument& argument) { return argument.name == scenario_argument().name; }

bool is_file(const Argument& argument) {
    static constexpr std::array<std::string_view, 7> words{"FILE", "FILE.md", "OUT",   "CAPTURE",
                                                           "A",    "B",       "FOLDER"};
    return std::find(words.begin(), words.end(), is_option(argument) ? argument.what : argument.name) !=
           words.end();
}

}  // namespace manual

namespace {

int run(const Arguments& arguments) {
    const auto what = arguments.text("WHAT");
    const auto text = what == "man"    ? manual::man_page(arguments.text("--date", "January 1, 1970"))
                      : what == "bash" ? manual::bash_completion()
                      : what == "zsh"  ? manual::zsh_completion()
                                       : manual::fish_completion();
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
}

}  // namespace

Verb manual_verb() {
    using Kind = Argument::Kind;
    return {"manual",
            "print the manual page, or a shell's completion",
            {{Kind::positional, "WHAT", "", "what to print", {"man", "bash", "zsh", "fish"}, true},
             {Kind::value, "--date", "DATE", "date of the manual page; default: January 1, 1970"}},
            "  echoloop manual man | mandoc -a\n"
            "  . <(echoloop manual bash)",
            run,
            true};
}

}  // namespace echoloop::cli
