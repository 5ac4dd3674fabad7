// The --json documents of the verbs that answer once; json_inspect.h and others have those of the rest. Text
// only; it writes nothing.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "emulator/scenario/scenario.h"
#include "render/echogram.h"
#include "render/scene/scene.h"
#include "tools/echoloop/bench/report.h"
#include "tools/echoloop/doctor/findings.h"
#include "tools/echoloop/driver.h"
#include "tools/echoloop/validate/findings.h"

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

/// {"ok": true, "findings": [{"state", "name", "text", "remedy"}]}
std::string doctor_json(const Findings& findings);
std::string bench_json(const bench::Report& report);
std::string validate_json(const validation::Findings& findings);

}  // namespace echoloop::cli
