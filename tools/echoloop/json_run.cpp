#include "tools/echoloop/json_run.h"

#include <nlohmann/json.hpp>

#include "emulator/pose/step_server.h"
#include "tools/echoloop/conditions.h"
#include "tools/echoloop/driver.h"
#include "tools/echoloop/json_line.h"

namespace echoloop::cli {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const PoseSummary& s) {
    return {{"place", s.place},     {"poses", s.accepted},
            {"refused", s.refused}, {"last_refusal", s.last_refusal},
            {"jumps", s.jumps},     {"stale_pings", s.stale_pings}};
}

}  // namespace

std::string run_started_json(const Scenario& scenario, const Runtime& runtime) {
    Json devices = Json::array();
    for (const auto& running : runtime.devices())
        devices.push_back(
            {{"name", running.name}, {"model", running.model->name}, {"places", running.places}});
    Json started{{"event", "started"},
                 {"scene", scenario.scene.string()},
                 {"triangles", runtime.triangles()},
                 {"renderer", runtime.renderer()},
                 {"clock", clock_text(scenario)},
                 {"devices", devices}};
    if (!scenario.control.empty()) started["control"] = runtime.control();
    if (!runtime.control_token().empty()) started["control_token"] = runtime.control_token();
    return line_of(started);
}

std::string run_summary_json(const std::vector<SessionSummary>& sessions, const Runtime& runtime,
                             const Recording* recording, const TruthFile* truth,
                             const BackgroundFile* labels) {
    Json devices = Json::array();
    for (const auto& s : sessions) {
        Json device{{"name", s.name}};
        for_each_figure(s, [&device](const char* name, auto value, bool) { device[name] = value; });
        devices.push_back(std::move(device));
    }
    Json ended{{"event", "ended"}, {"devices", devices}, {"stolen_s", runtime.stolen_seconds()}};
    if (const auto poses = runtime.poses()) ended["vehicle"] = json_of(*poses);
    for (const auto& [name, poses] : runtime.objects()) ended["objects"][name] = json_of(poses);
    if (const auto steps = runtime.steps())
        ended["clock"] = {{"steps", steps->steps},
                          {"refused", steps->refused},
                          {"last_refusal", steps->last_refusal},
                          {"run_time_s", to_seconds(steps->run_time)}};
    if (recording != nullptr) {
        const RecordingSummary s = recording->summary();
        ended["recording"] = {{"file", recording->file().string()},
                              {"files", s.files},
                              {"packets", s.packets},
                              {"bytes", s.bytes},
                              {"lost", s.lost},
                              {"stopped", s.stopped}};
    }
    if (truth != nullptr) {
        const BackgroundFileSummary s = truth->summary();
        ended["truth"] = {{"file", truth->file().string()},
                          {"lines", s.lines},
                          {"bytes", s.bytes},
                          {"lost", s.lost},
                          {"stopped", s.stopped}};
    }
    for (const auto& [device, counts] : runtime.faults())
        for (std::size_t i = 0; i < fault_kinds; ++i)
            if (counts[i] > 0) ended["faults"][device][fault_table()[i].name] = counts[i];
    if (labels != nullptr) {
        const BackgroundFileSummary s = labels->summary();
        ended["labels"] = {
            {"file", labels->file().string()}, {"lines", s.lines}, {"lost", s.lost}, {"stopped", s.stopped}};
    }
    return line_of(ended);
}

}  // namespace echoloop::cli
