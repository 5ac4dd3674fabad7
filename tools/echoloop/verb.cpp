#include "tools/echoloop/verb.h"

#include <cmath>

#include "emulator/contract/error.h"
#include "emulator/scenario/number.h"
#include "emulator/scenario/section.h"

namespace echoloop::cli {

std::span<const Verb> verbs() {
    static const std::vector<Verb> table{run_verb(),       check_verb(), examples_verb(),  list_verb(),
                                         endpoints_verb(), fault_verb(), render_verb(),    inspect_verb(),
                                         convert_verb(),   diff_verb(),  dissector_verb(), record_verb(),
                                         replay_verb(),    view_verb(),  bench_verb(),     validate_verb(),
                                         doctor_verb(),    sweep_verb(), import_verb(),    manual_verb()};
    return table;
}

Argument scenario_argument() {
    return {
        Argument::Kind::positional, "FILE", "", "scenario file (YAML), or the name of an example", {}, true};
}

Argument set_argument() {
    return {Argument::Kind::repeated, "--set", "PATH=VALUE",
            "change a value of the scenario, e.g. devices.micron.options.replies=1; may be repeated"};
}

Argument json_argument() {
    return {Argument::Kind::flag, "--json", "", "print one JSON document instead of text"};
}

std::string Arguments::text(std::string_view name, std::string fallback) const {
    const auto found = given_.find(name);
    return found == given_.end() || found->second.empty() ? fallback : found->second.front();
}

std::vector<std::string> Arguments::all(std::string_view name) const {
    const auto found = given_.find(name);
    return found == given_.end() ? std::vector<std::string>{} : found->second;
}

double Arguments::number(std::string_view name, double fallback, double minimum, double maximum) const {
    if (!has(name)) return fallback;
    const auto given = scenario::parse_number(text(name));
    if (given && std::isfinite(*given) && *given >= minimum && *given <= maximum) return *given;
    throw StartError(Exit::usage, std::string(name) + ": expected a number, " +
                                      scenario::text_of({minimum, maximum, ""}) + ", got " +
                                      scenario::in_quotes(text(name)));
}

}  // namespace echoloop::cli
