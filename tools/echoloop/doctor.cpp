// echoloop doctor: what on this machine, or in this scenario on it, will make trouble. Changes nothing.
#include <cstdio>

#include "emulator/contract/error.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/doctor/findings.h"
#include "tools/echoloop/json_output.h"

namespace echoloop::cli {
namespace {

void print(const Finding& finding) {
    static constexpr const char* words[] = {"good", "weak", "BAD"};
    std::printf("%s%s%s\n", padded(words[static_cast<int>(finding.state)], 6).c_str(),
                padded(finding.name, 18).c_str(), finding.text.c_str());
    if (!finding.remedy.empty()) std::printf("%s%s\n", padded("", 24).c_str(), finding.remedy.c_str());
}

int run_doctor(const Arguments& arguments) {
    Findings found;
    const auto add = [&](Findings more) { found.insert(found.end(), more.begin(), more.end()); };
    add(look_at_machine());
    add(look_at_graphics());
    add(look_at_lines());
    if (arguments.has("FILE")) add(look_at_scenario(scenario_from(arguments)));
    if (arguments.has("--json"))
        std::printf("%s\n", doctor_json(found).c_str());
    else
        for (const Finding& finding : found) print(finding);
    for (const Finding& finding : found)
        if (finding.state == Finding::State::bad)
            throw StartError(Exit::unavailable, finding.name + ": " + finding.text + "; " + finding.remedy);
    return 0;
}

}  // namespace

Verb doctor_verb() {
    Argument file = scenario_argument();
    file.kind = Argument::Kind::optional;
    file.required = false;
    file.help = "a scenario to try on this machine, without running it";
    return {"doctor",
            "look for what will cause trouble on this machine",
            {file, set_argument(), json_argument()},
            "  echoloop doctor\n"
            "  echoloop doctor demo",
            run_doctor};
}

}  // namespace echoloop::cli
