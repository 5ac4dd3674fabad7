// Every fault of a scenario with its place and its words. The cases are data: scenario/faults.txt.
#include <gmock/gmock.h>

#include <fstream>
#include <string>
#include <vector>

#include "emulator/scenario/scenario.h"
#include "tests/emulator/scenario_folder.h"
#include "tests/emulator/scenario_models.h"

namespace echoloop {
namespace {

/// "=== name" begins a case, "+++ argument" is a --set argument, ">>> text" an expected problem, of which
/// "..." at the end is any text (yaml-cpp 0.8 says more than 0.7); else YAML.
struct Fault {
    std::string name;
    std::string yaml;
    std::vector<std::string> sets;
    std::vector<std::string> expected;
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

std::vector<Fault> read_faults() {
    std::ifstream file(ECHOLOOP_SOURCE_DIR "/tests/emulator/scenario/faults.txt");
    std::vector<Fault> faults;
    for (std::string line; std::getline(file, line);) {
        const auto mark = line.substr(0, 4);
        if (mark == "=== ") {
            faults.push_back({line.substr(4), {}, {}, {}});
        } else if (faults.empty()) {
            continue;
        } else if (mark == "+++ ") {
            faults.back().sets.push_back(line.substr(4));
        } else if (mark == ">>> ") {
            faults.back().expected.push_back(line.substr(4));
        } else {
            faults.back().yaml += line + "\n";
        }
    }
    return faults;
}

testing::Matcher<std::string> reads(const std::string& expected) {
    if (!expected.ends_with("...")) return testing::Eq(expected);
    return testing::StartsWith(expected.substr(0, expected.size() - 3));
}

class ScenarioFaults : public testing::TestWithParam<Fault> {};

TEST_P(ScenarioFaults, are_reported_with_place_and_remedy) {
    const auto& fault = GetParam();
    test::in_scenario_folder();
    std::vector<std::string> seen;
    try {
        parse_scenario(fault.yaml, "t.yaml", fault.sets, test::test_models());
    } catch (const ScenarioError& error) {
        for (const auto& problem : error.problems()) seen.push_back(problem.text());
    }
    std::vector<testing::Matcher<std::string>> expected;
    for (const std::string& text : fault.expected) expected.push_back(reads(text));
    EXPECT_THAT(seen, testing::ElementsAreArray(expected));
    EXPECT_FALSE(fault.expected.empty());
}

INSTANTIATE_TEST_SUITE_P(File, ScenarioFaults, testing::ValuesIn(read_faults()), [](const auto& fault) {
    std::string name = std::to_string(fault.index) + "_";
    for (const char c : fault.param.name) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    return name;
});

TEST(ScenarioFaultFile, is_there) { EXPECT_GE(read_faults().size(), 40); }

}  // namespace
}  // namespace echoloop
