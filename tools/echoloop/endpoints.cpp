// echoloop endpoints: what to write into a driver's configuration. Opens nothing; the emulator need not run.
#include <cstdio>

#include "tools/echoloop/common.h"
#include "tools/echoloop/json_output.h"

namespace echoloop::cli {
namespace {

void print_places(const DeviceEndpoints& entry) {
    std::printf("%s%s\n", padded(entry.device->name, 16).c_str(), entry.device->model->name.c_str());
    for (const auto& place : entry.places) std::printf("  %s\n", place_line(place).c_str());
}

void print_hint(const DeviceEndpoints& entry) {
    const auto& hint = entry.hint;
    std::printf("# %s (%s)%s%s\n", entry.device->name.c_str(), entry.device->model->name.c_str(),
                hint.driver.empty() ? "" : ": ", hint.driver.c_str());
    const bool known = !hint.driver.empty();
    if (!hint.note.empty()) std::printf("# %s%s\n", hint.note.c_str(), known ? "" : "; its plain addresses:");
    if (!known)
        for (const auto& place : entry.places) std::printf("#   %s\n", place_line(place).c_str());
    for (const auto& line : hint.paste) std::printf("%s\n", line.c_str());
}

int run_endpoints(const Arguments& arguments) {
    const Scenario scenario = scenario_from(arguments);
    const auto format = arguments.text("--format");
    std::vector<DeviceEndpoints> devices;
    for (const auto& device : scenario.devices)
        devices.push_back(
            {&device, wire_places(device), format.empty() ? DriverHint{} : driver_hint(device, format)});
    if (arguments.has("--json")) {
        std::printf("%s\n", endpoints_json(format, devices).c_str());
        return 0;
    }
    for (const auto& entry : devices) format.empty() ? print_places(entry) : print_hint(entry);
    return 0;
}

}  // namespace

Verb endpoints_verb() {
    return {"endpoints",
            "print what to write into your driver's configuration",
            {scenario_argument(),
             {Argument::Kind::value, "--format", "FORMAT",
              "lines to paste into the configuration of this framework's drivers", driver_formats()},
             set_argument(),
             json_argument()},
            "  echoloop endpoints demo\n"
            "  echoloop endpoints demo --format ros1\n"
            "  echoloop endpoints demo --format rock --json",
            run_endpoints};
}

}  // namespace echoloop::cli
