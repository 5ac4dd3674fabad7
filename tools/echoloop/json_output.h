// The --json documents of the verbs. One of the two users of nlohmann-json's heavy header.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "emulator/scenario/scenario.h"
#include "render/echogram.h"
#include "render/scene/scene.h"
#include "tools/echoloop/driver.h"

namespace echoloop::cli {

/// {"ok": false, "problems": [{"where", "line", "column", "message"}]}
std::string problems_json(const std::vector<Problem>& problems);
std::string check_json(const Scenario& scenario, const Scene& scene);
std::string list_json(std::span<const Model> models);

struct DeviceEndpoints {
    const ScenarioDevice* device;
    std::vector<WirePlace> places;
    DriverHint hint;  ///< empty without a format
};
std::string endpoints_json(const std::string& format, const std::vector<DeviceEndpoints>& devices);

struct RenderReport {
    std::string out, device, model, renderer;
    std::vector<Echogram> pings;  ///< empty for --channels
};
std::string render_json(const RenderReport& report);

}  // namespace echoloop::cli
