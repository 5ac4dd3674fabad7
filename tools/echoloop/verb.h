// One verb of the program as a row of a table: its words for the help, its arguments, its function.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace echoloop::cli {

struct Argument {
    enum class Kind {
        positional,  ///< must be given
        optional,    ///< positional that may be left out
        flag,
        value,     ///< --name VALUE, at most once
        repeated,  ///< --name VALUE, any number of times
        words,     ///< positional, any number of them, at the end
    };

    Kind kind;
    std::string name;  ///< "FILE", or "--set"
    std::string what;  ///< word for its value in the help
    std::string help;
    std::vector<std::string> choices{};
    bool required = false;
};

/// What was given on the command line.
class Arguments {
  public:
    explicit Arguments(std::map<std::string, std::vector<std::string>, std::less<>> given)
        : given_(std::move(given)) {}

    bool has(std::string_view name) const { return given_.contains(name); }
    std::string text(std::string_view name, std::string fallback = {}) const;
    std::vector<std::string> all(std::string_view name) const;
    /// Throws StartError (usage) unless it is a finite number within the bounds.
    double number(std::string_view name, double fallback, double minimum, double maximum) const;

  private:
    std::map<std::string, std::vector<std::string>, std::less<>> given_;
};

struct Verb {
    std::string name;
    std::string summary;
    std::vector<Argument> arguments;
    std::string examples;
    int (*run)(const Arguments&);  ///< returns the exit status; throws StartError
    bool hidden = false;           ///< not shown in the help: for the makers of packages
};

/// All verbs in the order of the help.
std::span<const Verb> verbs();

Verb bench_verb();
Verb check_verb();
Verb convert_verb();
Verb diff_verb();
Verb dissector_verb();
Verb doctor_verb();
Verb endpoints_verb();
Verb examples_verb();
Verb fault_verb();
Verb import_verb();
Verb inspect_verb();
Verb list_verb();
Verb manual_verb();
Verb render_verb();
Verb record_verb();
Verb replay_verb();
Verb run_verb();
Verb sweep_verb();
Verb validate_verb();
Verb view_verb();

/// The arguments that many verbs share.
Argument scenario_argument();
Argument set_argument();
Argument json_argument();

}  // namespace echoloop::cli
