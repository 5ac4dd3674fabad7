// libFuzzer: any lines as arguments of --set over a scenario that is right. They change it, or they are
// refused with a reason for each.
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "emulator/scenario/scenario.h"
#include "tests/emulator/scenario_models.h"

namespace {

constexpr const char* right = R"(scene: tank.glb
water: {temperature: 10}
vehicle: {pose: {position: [0, 0, -3]}}
devices:
  - name: a
    model: tritech-micron
    endpoints: ["pty:/tmp/a"]
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
    std::vector<std::string> sets;
    for (std::string line; std::getline(lines, line) && sets.size() < 8;) sets.push_back(line);
    try {
        echoloop::parse_scenario(right, "fuzz.yaml", sets, echoloop::test::test_models());
    } catch (const echoloop::ScenarioError& error) {
        if (error.problems().empty()) std::abort();
    }
    return 0;
}
