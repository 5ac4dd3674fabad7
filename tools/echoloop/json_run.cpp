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

Json json_of(const PortPlace& port) {
    const Endpoint& place = port.place;
    Json json{{"name", port.name}, {"transport", scheme_name(place.scheme)}};
    if (place.path.empty())
        json.update({{"host", place.host}, {"port", place.port}});
    else
        json["path"] = place.path;
    return json;
}

Json json_of(const RunningDevice& device, const std::vector<Endpoint>& ends) {
    Json endpoints = Json::array(), ports = Json::array();
    for (const Endpoint& end : ends) endpoints.push_back(to_string(end));
    for (const PortPlace& port : device.ports) ports.push_back(json_of(port));
    return {{"name", device.name},
            {"model", device.model->name},
            {"family", device.model->family},
            {"endpoints", endpoints},
            {"ports", ports},
            {"places", device.places},
            {"open_to", device.open_to}};
}

/// Where a simulator and a test say what is to happen.
void tell_places(Json& started, const Runtime& runtime) {
    const Scenario& s = runtime.scenario();
    if (!s.control.empty()) started["control"] = s.control;
    if (!runtime.control_token().empty()) started["control_token"] = runtime.control_token();
    if (runtime.poses()) started["poses"] = s.pose_input.empty() ? s.step_input : s.pose_input;
    if (runtime.steps()) started["steps"] = s.step_input.empty() ? s.pose_input : s.step_input;
    for (const ScenarioObject& object : s.objects)
        if (!object.input.empty()) started["objects"][object.node] = object.input;
}

}  // namespace

std::string run_started_json(const Runtime& runtime, const std::string& view, const std::string& foxglove) {
    const Scenario& scenario = runtime.scenario();
    Json devices = Json::array();
    const auto running = runtime.devices();
    for (std::size_t i = 0; i < running.size(); ++i)
        devices.push_back(json_of(running[i], scenario.devices[i].config.endpoints));
    Json started{{"event", "started"},
                 {"version", ECHOLOOP_VERSION},
                 {"ready", true},
                 {"scene", scenario.scene.string()},
                 {"triangles", runtime.triangles()},
                 {"renderer", runtime.renderer()},
                 {"clock", clock_text(scenario)},
                 {"devices", devices}};
    tell_places(started, runtime);
    if (!view.empty()) started["view"] = view;
    if (!foxglove.empty()) started["foxglove"] = foxglove;
    return line_of(started);
}

std::string run_summary_json(const std::vector<SessionSummary>& sessions, const Runtime& runtime,
                             const Recording* recording, const TruthFile* truth, const BackgroundFile* labels,
                             const Dataset* dataset, const bag::Bag* bag) {
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
    if (dataset != nullptr) {
        const DatasetSummary s = dataset->summary();
        ended["dataset"] = {
            {"folder", dataset->folder().string()}, {"pings", s.pings}, {"bytes", s.bytes}, {"lost", s.lost}};
    }
    if (bag != nullptr) {
        const bag::BagSummary s = bag->summary();
        ended["bag"] = {
            {"file", bag->file().string()}, {"messages", s.messages}, {"bytes", s.bytes}, {"lost", s.lost}};
    }
    return line_of(ended);
}

}  // namespace echoloop::cli
