// echoloop diff: two captures message by message and field by field, e.g. a real sonar's against the
// emulator's.
#include <algorithm>

#include "emulator/scenario/number.h"
#include "emulator/scenario/problems.h"
#include "emulator/scenario/value.h"
#include "tools/echoloop/diff/compare.h"
#include "tools/echoloop/diff/json.h"
#include "tools/echoloop/diff/text.h"
#include "tools/echoloop/terminal.h"
#include "tools/echoloop/verb.h"

namespace echoloop::cli {
namespace {

const inspect::Family* family_of(const Arguments& arguments) {
    if (!arguments.has("--family")) return nullptr;
    const auto wanted = arguments.text("--family");
    if (const auto* family = inspect::find_family(wanted)) return family;
    std::vector<std::string_view> known;
    for (const auto& family : inspect::families()) known.push_back(family.name);
    throw StartError(Exit::usage, "--family: unknown family " + scenario::in_quotes(wanted) +
                                      scenario::suggestion(wanted, known));
}

diff::Rules rules_of(const Arguments& arguments) {
    diff::Rules rules;
    for (const auto& field : arguments.all("--ignore")) rules.ignore(field);
    for (const auto& text : arguments.all("--tolerance")) {
        const std::size_t sign = text.rfind('=');
        const auto limit =
            sign == std::string::npos ? std::nullopt : scenario::parse_number(text.substr(sign + 1));
        if (!limit || !(*limit >= 0) || sign == 0)
            throw StartError(Exit::usage, "--tolerance: expected FIELD=NUMBER, the number 0 or more, got " +
                                              scenario::in_quotes(text));
        rules.set_limit(text.substr(0, sign), *limit);
    }
    if (arguments.has("--everything")) rules.compare_everything();
    return rules;
}

diff::SideSettings settings_of(const Arguments& arguments, const char* own_port) {
    diff::SideSettings settings;
    settings.family = family_of(arguments);
    settings.port = arguments.text(own_port, arguments.text("--port"));
    return settings;
}

int run(const Arguments& arguments) {
    const diff::Rules rules = rules_of(arguments);
    const auto a = diff::read_side(arguments.text("A"), settings_of(arguments, "--port-a"));
    const auto b = diff::read_side(arguments.text("B"), settings_of(arguments, "--port-b"));
    const diff::Report report = diff::compare(a, b, rules);
    for (const auto& warning : report.warnings) print_warning(warning);
    if (arguments.has("--json"))
        std::printf("%s\n", diff::report_json(report).c_str());
    else
        diff::print(report, arguments.has("--all"));
    return report.differs() ? 1 : 0;
}

}  // namespace

Verb diff_verb() {
    using Kind = Argument::Kind;
    return {"diff",
            "compare two captures, message by message and field by field",
            {{Kind::positional,
              "A",
              "",
              "pcap, pcapng, a maker's recording, a serial log, or raw bytes",
              {},
              true},
             {Kind::positional,
              "B",
              "",
              "the other capture, e.g. of the emulator with the same commands",
              {},
              true},
             {Kind::repeated, "--ignore", "FIELD", "do not compare this field; may be repeated"},
             {Kind::repeated, "--tolerance", "FIELD=X",
              "ignore differences up to X; for long arrays X is the allowed relative rms difference (0.1; 0: "
              "exact)"},
             {Kind::flag, "--everything", "",
              "also compare times, counters and checksums, and long arrays exactly"},
             {Kind::value, "--port", "PORT",
              "compare only this traffic: a port, an address, or a serial line's name"},
             {Kind::value, "--port-a", "PORT", "as --port, for A only"},
             {Kind::value, "--port-b", "PORT", "as --port, for B only"},
             {Kind::value, "--family", "NAME", "protocol family; default: guessed"},
             {Kind::flag, "--all", "", "also print fields that are equal"},
             json_argument()},
            "  echoloop diff real.pcapng emulated.pcapng        exit status 0: equal, 1: different\n"
            "  echoloop diff real.pcapng emulated.pcapng --port-a 65500 --ignore serial --tolerance "
            "sound_speed=0.5\n"
            "  echoloop diff a.pcapng b.pcapng --tolerance bins=0 --json",
            run};
}

}  // namespace echoloop::cli
