#include "emulator/run/answers.h"

#include <nlohmann/json.hpp>

#include "emulator/faults/seconds.h"

namespace echoloop::answers {
namespace {

using Json = nlohmann::ordered_json;

std::string line_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json to_json(const AskedFault& asked, Time now) {
    const Fault& fault = asked.fault;
    const FaultRow& row = row_of(fault.kind);
    Json json{{"id", asked.id}, {"device", fault.device}, {"kind", row.name}};
    if (!fault.port.empty()) json["port"] = fault.port;
    if (row.where == FaultRow::Where::bytes) json["direction"] = name_of(fault.direction);
    for (const auto& [name, value] : fault.parameters)
        std::visit([&json, &key = name](const auto& v) { json[key] = v; }, value);
    json["from"] = told_seconds(fault.from);
    if (!row.momentary && fault.length != Time::max()) json["for"] = told_seconds(fault.length);
    if (fault.every > Time{}) json["every"] = told_seconds(fault.every);
    json["on"] = fault.on_until(now).has_value();
    json["made"] = asked.made;
    return json;
}

}  // namespace

std::string refusal(const std::string& reason) { return line_of({{"ok", false}, {"error", reason}}); }
std::string welcome() { return line_of({{"ok", true}}); }
std::string added(int id) { return line_of({{"ok", true}, {"id", id}}); }
std::string cleared(std::size_t count) { return line_of({{"ok", true}, {"cleared", count}}); }

std::string list(const Faults& faults, Time now) {
    Json asked = Json::array();
    for (const DeviceFaults& device : faults.devices())
        for (const AskedFault& one : device.asked()) asked.push_back(to_json(one, now));
    return line_of({{"ok", true}, {"t", told_seconds(now)}, {"faults", asked}});
}

std::string status(const std::vector<SessionSummary>& sessions, RenderThreads::Load rendering,
                   const Faults& faults, Time now) {
    Json devices = Json::array();
    for (const SessionSummary& s : sessions) {
        Json made = Json::object();
        if (const auto found = faults.labels().counts().find(s.name); found != faults.labels().counts().end())
            for (std::size_t i = 0; i < fault_kinds; ++i)
                if (found->second[i] > 0) made[fault_table()[i].name] = found->second[i];
        Json device{{"name", s.name}};
        for_each_figure(s, [&device](const char* name, auto value, bool while_running) {
            if (while_running) device[name] = value;
        });
        device["waiting"] = s.waiting;
        device["waiting_bytes"] = s.waiting_bytes;
        device["connected"] = s.connected;
        device["faults"] = std::move(made);
        devices.push_back(std::move(device));
    }
    return line_of(
        {{"ok", true},
         {"t", told_seconds(now)},
         {"rendering",
          {{"threads", rendering.threads}, {"drawing", rendering.drawing}, {"waiting", rendering.waiting}}},
         {"devices", devices}});
}

}  // namespace echoloop::answers
