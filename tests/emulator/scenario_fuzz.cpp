// libFuzzer: any text as a scenario. A line that begins with "+++ " is a --set argument.
#include <cstddef>
#include <cstdint>
#include <sstream>

#include "emulator/scenario/scenario.h"
#include "tests/emulator/scenario_models.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
    std::string text;
    std::vector<std::string> sets;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("+++ ")) {
            sets.push_back(line.substr(4));
        } else {
            text += line + "\n";
        }
    }
    try {
        echoloop::parse_scenario(text, "fuzz.yaml", sets, echoloop::test::test_models());
    } catch (const echoloop::ScenarioError&) {
    }
    return 0;
}
