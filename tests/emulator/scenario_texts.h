// Scenarios as text, and what becomes of them.
#pragma once

#include <string>
#include <vector>

#include "emulator/scenario/scenario.h"
#include "tests/emulator/scenario_folder.h"
#include "tests/emulator/scenario_models.h"

namespace echoloop::test {

inline Scenario parse(const std::string& text, const std::vector<std::string>& sets = {}) {
    in_scenario_folder();
    return parse_scenario(text, "t.yaml", sets, test_models());
}

inline std::string refusal(const std::string& text, const std::vector<std::string>& sets = {}) {
    try {
        parse(text, sets);
    } catch (const ScenarioError& error) {
        return error.what();
    }
    return "accepted";
}

constexpr auto smallest = "scene: s.glb\ndevices: [{name: micron, model: tritech-micron}]\n";

constexpr auto complete = R"(
scene: s.glb
seed: 18446744073709551615
water: {temperature: 4.5, salinity: 0, ph: 7, depth: 12, sound_speed: 1480}
vehicle:
  pose: {position: [1, -2.5, -3], rpy_deg: [0, 0, 90]}
clock: {mode: scaled, rate: 5}
render: {rule: cerqueira2016, context: osmesa, sampler: rays, pixels: 2}
devices:
  - name: front
    model: tritech-micron
    mount: {position: [0.4, 0, 0.1], rpy_deg: [180, 0, 0]}
    endpoints: ["serial:///dev/ttyUSB0:115200"]
    options: {gain: 20, bins: 200, inverted: true, profile: miniking, serial_number: 0042}
  - {name: fan, model: r2sonic-2024, endpoints: ["udp-listen://localhost:4000"]}
)";

}  // namespace echoloop::test
