#include "emulator/faults/control_line.h"

#include "emulator/scenario/faults_section.h"
#include "emulator/scenario/number.h"
#include "emulator/scenario/yaml.h"

namespace echoloop {
namespace {

using namespace scenario;

constexpr auto known =
    "; known are {\"fault\": {...}}, {\"clear\": 3 or \"all\"}, {\"list\": true}, "
    "{\"status\": true}";

ControlLine refused(std::string reason) { return {{}, std::move(reason)}; }

ControlLine read_clear(const Value& value) {
    ControlRequest request{ControlRequest::What::clear};
    if (value.is_scalar() && value.text == "all") return {request, ""};
    request.id = value.is_scalar() && !value.quoted ? parse_as<int>(value.text) : std::nullopt;
    if (!request.id) return refused("clear: expected the number of a fault or \"all\"");
    return {request, ""};
}

ControlLine read_fault_request(const Value& value, std::span<const ScenarioDevice> devices, Time now) {
    Problems problems("", {});
    ControlRequest request{ControlRequest::What::fault, read_fault(value, "fault", devices, now, problems)};
    try {
        problems.throw_if_any();
        return {std::move(request), ""};
    } catch (const ScenarioError& error) {
        std::string reason;
        for (const Problem& problem : error.problems())
            reason += (reason.empty() ? "" : "; ") + problem.message;
        return refused(std::move(reason));
    }
}

ControlLine read_flag(const Value& value, ControlRequest::What what) {
    if (value.is_scalar() && !value.quoted && value.text == "true") return {ControlRequest{what}, ""};
    return refused(value.key + ": expected true");
}

}  // namespace

ControlLine parse_control_line(std::string_view line, std::span<const ScenarioDevice> devices, Time now) {
    if (line.size() > longest_control_line) return refused("the line is longer than 4096 bytes");
    while (line.ends_with('\r') || line.ends_with(' ')) line.remove_suffix(1);
    Value root;
    try {
        root = parse_yaml(std::string(line));  // JSON is YAML, and the scenario's reader of faults reads YAML
    } catch (const YamlError& error) {
        return refused("no JSON: " + error.message);
    }
    if (!root.is_map()) return refused("expected a JSON object in braces" + std::string(known));
    if (root.items.size() != 1) return refused("expected one request in a line" + std::string(known));
    const Value& value = root.items.front();
    if (value.key == "fault") return read_fault_request(value, devices, now);
    if (value.key == "clear") return read_clear(value);
    if (value.key == "list") return read_flag(value, ControlRequest::What::list);
    if (value.key == "status") return read_flag(value, ControlRequest::What::status);
    return refused("unknown request " + in_quotes(value.key) + known);
}

}  // namespace echoloop
