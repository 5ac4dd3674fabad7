#include "tools/echoloop/json_inspect.h"

#include <nlohmann/json.hpp>

#include "tools/echoloop/common.h"
#include "tools/echoloop/json_line.h"

namespace echoloop::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Text from files may hold bytes that are no UTF-8; they are replaced, never an error.
}  // namespace

std::string comments_json(const std::vector<PacketComment>& comments) {
    Json json = Json::array();
    for (const auto& one : comments)
        json.push_back({{"packet", one.packet}, {"time", one.time}, {"comment", one.text}});
    return line_of(json);
}

std::string message_json(const InspectOrigin& origin, const inspect::Message& message) {
    Json json;
    if (origin.from)
        json.update({{"time", origin.time}, {"from", text_of(*origin.from)}, {"to", text_of(*origin.to)}});
    if (!origin.line.empty()) json.update({{"time", origin.time}, {"line", origin.line}});
    if (origin.packet != 0) json["packet"] = origin.packet;
    json.update({{"family", origin.family},
                 {"name", message.name},
                 {"offset", message.offset},
                 {"size", message.size},
                 {"reason", message.reason}});
    Json fields = Json::array();
    for (const auto& f : message.fields) {
        Json field{{"name", f.name}, {"offset", f.offset}, {"size", f.size}};
        if (!f.unit.empty()) field["unit"] = f.unit;
        if (f.number) {
            field["value"] = *f.number;
        } else if (!f.numbers.empty()) {
            field["value"] = f.numbers;
        } else {
            field["value"] = f.text;
        }
        fields.push_back(field);
    }
    json["fields"] = fields;
    return line_of(json);
}

std::string summary_json(const InspectSummary& summary) {
    Json json{{"messages", summary.messages},
              {"broken", summary.broken},
              {"undecoded_bytes", summary.undecoded_bytes}};
    if (summary.comments > 0) json["comments"] = summary.comments;
    if (summary.packets)
        json.update({{"packets", *summary.packets},
                     {"skipped_packets", summary.skipped_packets},
                     {"incomplete_datagrams", summary.incomplete}});
    return line_of(json);
}

}  // namespace echoloop::cli
