#include "tools/echoloop/json_replay.h"

#include <nlohmann/json.hpp>

#include "tools/echoloop/json_line.h"

namespace echoloop::cli {
namespace {

using Json = nlohmann::ordered_json;

Json side_json(const capture::SideCounts& side) { return {{"pieces", side.pieces}, {"bytes", side.bytes}}; }

const char* kind_name(capture::PortKind kind) {
    switch (kind) {
        case capture::PortKind::serial:
            return "serial";
        case capture::PortKind::tcp:
            return "tcp";
        case capture::PortKind::udp:
            return "udp";
    }
    return "";
}

}  // namespace

std::string ports_json(const capture::Survey& survey) {
    Json ports = Json::array();
    for (const auto& port : survey.ports)
        ports.push_back({{"name", port.text()},
                         {"kind", kind_name(port.key.kind)},
                         {"device", side_json(port.device())},
                         {"driver", side_json(port.driver())},
                         {"begin", port.begin - survey.begin},
                         {"end", port.end - survey.begin}});
    return line_of({{"ports", ports},
                    {"packets", survey.counts.packets},
                    {"skipped_packets", survey.counts.skipped},
                    {"missing_fragments", survey.counts.incomplete},
                    {"cut_datagrams", survey.cut},
                    {"damaged_bytes", survey.counts.damaged_bytes},
                    {"clock_steps_back", survey.counts.steps_back},
                    {"fault", survey.counts.fault}});
}

std::string replay_started_json(const std::vector<Assignment>& assignments, const replay::Replay& replay,
                                const std::string& view) {
    Json ports = Json::array();
    const auto places = replay.places();
    for (std::size_t i = 0; i < assignments.size(); ++i)
        ports.push_back({{"name", assignments[i].name}, {"place", places[i]}});
    Json started{{"event", "started"}, {"ports", ports}};
    if (!view.empty()) started["view"] = view;
    return line_of(started);
}

std::string replay_summary_json(const replay::Summary& summary, const replay::PlayerCounts& counts) {
    return line_of({{"event", "ended"},
                    {"driver_came", summary.driver_came},
                    {"seconds", summary.seconds},
                    {"messages", summary.messages},
                    {"bytes", summary.bytes},
                    {"bytes_taken", summary.taken},
                    {"bytes_in", summary.bytes_in},
                    {"worst_lateness_s", to_seconds(summary.worst_lateness)},
                    {"laps", counts.laps},
                    {"requests", counts.requests},
                    {"answered", counts.answered},
                    {"unanswered", counts.unanswered},
                    {"noise_bytes", counts.noise}});
}

std::string relay_started_json(const replay::Relay& relay) {
    return line_of(
        {{"event", "started"}, {"device", relay.device_place()}, {"driver", relay.driver_place()}});
}

std::string relay_summary_json(const replay::RelaySummary& passed, const RecordingSummary& recorded) {
    return line_of({{"event", "ended"},
                    {"from_device_bytes", passed.from_device},
                    {"from_driver_bytes", passed.from_driver},
                    {"lost_bytes", passed.lost},
                    {"packets", recorded.packets},
                    {"recorded_bytes", recorded.bytes},
                    {"files", recorded.files},
                    {"lost_packets", recorded.lost},
                    {"stopped", recorded.stopped}});
}

}  // namespace echoloop::cli
