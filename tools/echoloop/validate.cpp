// echoloop validate: published values and recordings of underwater acoustics beside what this program makes
// of them.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "emulator/contract/error.h"
#include "emulator/scenario/problems.h"
#include "tools/echoloop/json_output.h"
#include "tools/echoloop/output_file.h"
#include "tools/echoloop/terminal.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/report.h"
#include "tools/echoloop/verb.h"

namespace echoloop::cli {
namespace {

/// The groups of --only, or all.
std::vector<validation::Group> chosen(const Arguments& arguments) {
    const std::string words = arguments.text("--only");
    const auto all = validation::groups();
    if (words.empty()) return {all.begin(), all.end()};
    std::vector<validation::Group> groups;
    for (std::size_t begin = 0; begin <= words.size();) {
        const std::size_t end = std::min(words.find(',', begin), words.size());
        const std::string word = words.substr(begin, end - begin);
        const std::size_t before = groups.size();
        std::vector<std::string_view> known;
        for (const validation::Group& group : all) {
            known.push_back(group.id);
            if (group.id == word) groups.push_back(group);
        }
        if (groups.size() == before)
            throw StartError(Exit::usage, "--only: there is no check " + scenario::in_quotes(word) +
                                              scenario::suggestion(word, known));
        begin = end + 1;
    }
    return groups;
}

/// The folder of --recordings, empty without one.
std::filesystem::path recordings(const Arguments& arguments) {
    const std::filesystem::path folder = arguments.text("--recordings");
    if (!folder.empty() && !std::filesystem::is_directory(folder))
        throw StartError(Exit::no_input,
                         "--recordings: there is no folder " + scenario::in_quotes(folder.string()));
    return folder;
}

validation::Findings found(const std::vector<validation::Group>& groups, std::filesystem::path folder) {
    validation::Findings findings;
    findings.use_recordings(std::move(folder));
    Progress progress("checking", groups.size());
    for (std::size_t i = 0; i < groups.size(); ++i) {
        findings.begin(std::string(groups[i].id));
        groups[i].check(findings);
        progress.done(i + 1);
    }
    return findings;
}

int run_validate(const Arguments& arguments) {
    const auto groups = chosen(arguments);
    const std::filesystem::path report = arguments.text("--report");
    const auto folder = recordings(arguments);
    if (!report.empty()) require_creatable(report);
    try {
        const auto findings = found(groups, folder);
        if (!report.empty()) validation::write_report(findings, report);
        if (arguments.has("--json")) {
            std::printf("%s\n", validate_json(findings).c_str());
        } else {
            std::printf("%s", validation::text_of(findings, coloured(STDOUT_FILENO)).c_str());
        }
        return findings.failed() == 0 ? 0 : 1;
    } catch (const StartError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw StartError(Exit::unavailable, error.what());
    }
}

}  // namespace

Verb validate_verb() {
    using Kind = Argument::Kind;
    return {"validate",
            "compare levels, times and patterns with published values and recordings",
            {{Kind::value, "--only", "V1,...", "run only these checks"},
             {Kind::value, "--recordings", "DIR",
              "also read real devices' recordings there: r2sonic, oculus, imagenex852, sonar-3d-15"},
             {Kind::value, "--report", "FILE.md", "also write the table and its pictures there"},
             json_argument()},
            "  echoloop validate                     exit status 1 if a required quantity is out of its "
            "tolerance\n"
            "  echoloop validate --only V5,V8\n"
            "  echoloop validate --only R1 --recordings ../shared/data\n"
            "  echoloop validate --report docs/validation.md",
            run_validate};
}

}  // namespace echoloop::cli
