#include "tools/echoloop/faults_output.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "emulator/scenario/section.h"
#include "tools/echoloop/common.h"

namespace echoloop::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string value_text(const Option& option) {
    if (const auto* whole = std::get_if<std::int64_t>(&option.default_value)) return std::to_string(*whole);
    const double number = std::get<double>(option.default_value);
    return plain(number, 9);
}

std::string range_text(const Option& option) {
    return scenario::text_of({option.minimum, option.maximum, option.unit});
}

std::string sentence(const FaultRow& row) {
    return row.help + (row.needs.empty() ? "" : "; for devices with " + row.needs);
}

std::string kind_of_time(const FaultRow& row) {
    if (row.momentary) return "at a moment";
    return row.needs_end ? "for a time" : "always, or for a time";
}

}  // namespace

void print_fault_kinds() {
    std::size_t name = 0, parameter = 0;
    for (const FaultRow& row : fault_table()) {
        name = std::max(name, row.name.size() + 2);
        for (const Option& option : row.parameters) parameter = std::max(parameter, option.name.size() + 2);
    }
    for (const FaultRow& row : fault_table()) {
        std::printf("%s%s (%s)\n", padded(row.name, name).c_str(), sentence(row).c_str(),
                    kind_of_time(row).c_str());
        for (const Option& option : row.parameters)
            std::printf("%s%s%s%s: %s\n", padded("", name).c_str(), padded(option.name, parameter).c_str(),
                        padded(value_text(option), 8).c_str(), range_text(option).c_str(),
                        option.help.c_str());
    }
    std::printf(
        "\nIn a scenario: faults: [{device: micron, kind: bit_flips, rate: 1e-4, from: 10, until: 20}]\n"
        "Each has a device and a kind, and may have: port, direction (to_driver, from_driver, both), from "
        "or\n"
        "at, until or for, every (s of run time). docs/faults.md tells more.\n");
}

std::string fault_kinds_json() {
    Json kinds = Json::array();
    for (const FaultRow& row : fault_table()) {
        Json parameters = Json::array();
        for (const Option& option : row.parameters) {
            Json value;
            std::visit([&value](const auto& v) { value = v; }, option.default_value);
            parameters.push_back({{"name", option.name},
                                  {"unit", option.unit},
                                  {"default", value},
                                  {"minimum", option.minimum},
                                  {"maximum", option.maximum},
                                  {"help", option.help}});
        }
        kinds.push_back({{"name", row.name},
                         {"help", row.help},
                         {"needs", row.needs},
                         {"momentary", row.momentary},
                         {"parameters", parameters}});
    }
    return Json{{"faults", kinds}}.dump(2);
}

std::unique_ptr<BackgroundFile> labels_from(const Arguments& arguments) {
    return arguments.has("--labels")
               ? std::make_unique<BackgroundFile>(arguments.text("--labels"), "the label file")
               : nullptr;
}

void print_faults(const std::map<std::string, FaultCounts>& counts) {
    for (const auto& [device, of_kind] : counts) {
        std::string text;
        for (std::size_t i = 0; i < fault_kinds; ++i)
            if (of_kind[i] > 0)
                text += (text.empty() ? "" : ", ") + std::to_string(of_kind[i]) + " " + fault_table()[i].name;
        if (!text.empty())
            std::printf("%son %s: %s\n", padded("faults", 16).c_str(), device.c_str(), text.c_str());
    }
}

void print_labels(const BackgroundFile& labels) {
    const BackgroundFileSummary s = labels.summary();
    std::printf(
        "%s%s: %s%s%s\n", padded("labels", 16).c_str(), labels.file().c_str(),
        counted(s.lines, "line").c_str(),
        s.lost == 0 ? "" : ("; the disk was too slow for " + std::to_string(s.lost) + " more").c_str(),
        s.stopped ? "; it stopped early, see above" : "");
}

}  // namespace echoloop::cli
