#include <algorithm>

#include "tools/echoloop/manual/manual.h"

namespace echoloop::cli::manual {
namespace {

/// The first words of a list that the program itself prints: "demo", "tritech-micron".
constexpr auto example_names = "$(echoloop examples 2>/dev/null | cut -d' ' -f1)";
constexpr auto model_names = "$(echoloop list 2>/dev/null | sed '/^$/,$d;s/ .*//')";

std::string joined(const std::vector<std::string>& words) {
    std::string out;
    for (const auto& word : words) out += (out.empty() ? "" : " ") + word;
    return out;
}

/// With a backslash before each of `special`.
std::string escaped(const std::string& text, std::string_view special) {
    std::string out;
    for (const char c : text) {
        if (special.find(c) != std::string_view::npos) out += '\\';
        out += c;
    }
    return out;
}

/// In single quotes of bash and zsh.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

bool is_models(const Argument& argument) { return argument.name == "MODEL"; }
bool is_example(const Argument& argument) { return argument.name == "NAME" && !is_option(argument); }

/// Shell words that can stand for an argument; "" if nobody knows.
std::string values(const Argument& argument) {
    if (!argument.choices.empty()) return joined(argument.choices);
    if (is_scenario(argument) || is_example(argument)) return example_names;
    if (is_models(argument)) return model_names;
    return "";
}

std::string bash_case(const Verb& verb) {
    std::string options = "--help", words, files = "false", out = "        " + verb.name + ")\n";
    out += "            case $previous in\n";
    for (const Argument& argument : verb.arguments) {
        if (!is_option(argument)) {
            if (!values(argument).empty()) words += (words.empty() ? "" : " ") + values(argument);
            if (is_file(argument)) files = "true";
            continue;
        }
        options += " " + argument.name;
        if (argument.kind == Argument::Kind::flag) continue;
        out += "                " + argument.name +
               ") words=" + (values(argument).empty() ? "" : "\"" + values(argument) + "\"") +
               " files=" + (is_file(argument) ? "true" : "false") + " ;;\n";
    }
    out += "                *) words=\"" + words + "\" files=" + files + " options=\"" + options + "\" ;;\n";
    return out + "            esac ;;\n";
}

/// What `_arguments` of zsh does for the value of an argument.
std::string zsh_action(const Argument& argument) {
    const auto words = values(argument);
    if (is_scenario(argument)) return std::string("{_files; compadd -- ") + words + "}";
    if (!argument.choices.empty()) return "(" + words + ")";
    if (!words.empty()) return std::string("{compadd -- ") + words + "}";
    return is_file(argument) ? "_files" : " ";
}

std::string zsh_spec(const Argument& argument) {
    using Kind = Argument::Kind;
    const auto help = escaped(argument.help, "[]:\\");
    const auto action = zsh_action(argument);
    switch (argument.kind) {
        case Kind::flag:
            return quoted(argument.name + "[" + help + "]");
        case Kind::value:
        case Kind::repeated:
            return quoted((argument.kind == Kind::repeated ? "*" : "") + argument.name + "=[" + help +
                          "]:" + escaped(argument.what, ":\\") + ":" + action);
        case Kind::positional:
            return quoted(":" + argument.name + ":" + action);
        case Kind::optional:
            return quoted("::" + argument.name + ":" + action);
        case Kind::words:
            return quoted("*:" + argument.name + ":" + action);
    }
    return {};
}

/// In single quotes of fish.
std::string fish_quoted(const std::string& text) { return "'" + escaped(text, "'\\") + "'"; }

std::string fish_lines(const Verb& verb) {
    const std::string here =
        "complete -c echoloop -n " + fish_quoted("__fish_seen_subcommand_from " + verb.name);
    std::string out;
    const auto takes_files = std::any_of(verb.arguments.begin(), verb.arguments.end(),
                                         [](const auto& a) { return !is_option(a) && is_file(a); });
    if (takes_files) out += here + " -F\n";
    for (const Argument& argument : verb.arguments) {
        std::string words = values(argument);
        if (words.starts_with("$")) words.erase(0, 1);  // (command) is the substitution of fish
        if (!is_option(argument)) {
            if (!words.empty()) out += here + " -a " + fish_quoted(words) + "\n";
            continue;
        }
        out += here + " -l " + argument.name.substr(2) + " -d " + fish_quoted(argument.help);
        if (argument.kind != Argument::Kind::flag) out += is_file(argument) ? " -r -F" : " -x";
        if (!words.empty()) out += " -a " + fish_quoted(words);
        out += "\n";
    }
    return out;
}

}  // namespace

std::string bash_completion() {
    std::string names;
    for (const Verb* verb : shown_verbs()) names += (names.empty() ? "" : " ") + verb->name;
    std::string out =
        "# Completion of echoloop in bash, made by the program.\n"
        "_echoloop() {\n"
        "    local word=$2 previous=$3 words='' files=false options=''\n"
        "    COMPREPLY=()\n"
        "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
        "        words=\"" +
        names +
        "\" options='--help --version'\n"
        "    fi\n"
        "    case ${COMP_WORDS[1]} in\n";
    for (const Verb* verb : shown_verbs()) out += bash_case(*verb);
    return out +
           "    esac\n"
           "    case $word in -*) words=$options files=false ;; esac\n"
           "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
           "    if $files; then\n"
           "        compopt -o filenames\n"
           "        mapfile -t -O \"${#COMPREPLY[@]}\" COMPREPLY < <(compgen -f -- \"$word\")\n"
           "    fi\n"
           "}\n"
           "complete -F _echoloop echoloop\n";
}

std::string zsh_completion() {
    std::string out =
        "#compdef echoloop\n"
        "# Completion of echoloop in zsh, made by the program.\n"
        "_echoloop() {\n"
        "    local -a verbs=(\n";
    for (const Verb* verb : shown_verbs())
        out += "        " + quoted(verb->name + ":" + escaped(verb->summary, ":\\")) + "\n";
    out +=
        "    )\n"
        "    if (( CURRENT == 2 )); then\n"
        "        _describe verb verbs\n"
        "        _arguments '--help[show the verbs]' '--version[show the version]'\n"
        "        return\n"
        "    fi\n"
        "    local verb=$words[2]\n"
        "    shift words\n"
        "    (( CURRENT-- ))\n"
        "    case $verb in\n";
    for (const Verb* verb : shown_verbs()) {
        out += "        " + verb->name + ")\n            _arguments '--help[show arguments and examples]'";
        for (const Argument& argument : verb->arguments) out += " \\\n                " + zsh_spec(argument);
        out += " ;;\n";
    }
    return out +
           "    esac\n"
           "}\n"
           "if [ \"$funcstack[1]\" = _echoloop ]; then _echoloop \"$@\"; else compdef _echoloop echoloop; "
           "fi\n";
}

std::string fish_completion() {
    std::string out =
        "# Completion of echoloop in fish, made by the program.\n"
        "complete -c echoloop -f\n"
        "complete -c echoloop -l help -d 'show arguments and examples'\n"
        "complete -c echoloop -n __fish_use_subcommand -l version -d 'show the version'\n";
    for (const Verb* verb : shown_verbs())
        out += "complete -c echoloop -n __fish_use_subcommand -a " + verb->name + " -d " +
               fish_quoted(verb->summary) + "\n";
    for (const Verb* verb : shown_verbs()) out += fish_lines(*verb);
    return out;
}

}  // namespace echoloop::cli::manual
