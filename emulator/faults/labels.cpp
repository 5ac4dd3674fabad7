#include "emulator/faults/labels.h"

#include <nlohmann/json.hpp>

#include "emulator/faults/seconds.h"

namespace echoloop {
namespace {

using Json = nlohmann::ordered_json;

std::string line_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Nothing of the message that it was made on passes the wire.
bool is_absent(FaultKind kind) { return kind == FaultKind::loss || kind == FaultKind::silence; }

}  // namespace

FaultLabels::FaultLabels(BackgroundFile* file, std::uint64_t seed, const std::string& scenario,
                         UnixTime unix_time)
    : file_(file), unix_time_(std::move(unix_time)) {
    if (file_ == nullptr) return;
    file_->add(line_of({{"format", "echoloop fault labels"},
                        {"version", 1},
                        {"seed", seed},
                        {"scenario", scenario},
                        {"unix", unix_time_()}}));
}

void FaultLabels::add(Time now, const FaultPlace& place, const FaultEvent& event) {
    const FaultRow& row = row_of(event.kind);
    if (!event.is_end) ++counts_[place.device][static_cast<std::size_t>(event.kind)];
    if (watch_ != nullptr)
        watch_->fault({place.device, place.port, unix_time_(),
                       comment_of(event) + (event.is_end ? ", which has ended" : ""),
                       event.message && !is_absent(event.kind), place.direction == Towards::to_driver});
    if (file_ == nullptr) return;
    Json json{{"t", told_seconds(now)}, {"unix", unix_time_()}, {"device", place.device}};
    if (!place.port.empty()) json["port"] = place.port;
    if (row.where == FaultRow::Where::bytes) json["direction"] = name_of(place.direction);
    if (event.ping) json["ping"] = *event.ping;
    if (event.message) json["message"] = *event.message;
    if (row.where == FaultRow::Where::bytes) {
        json["offset"] = event.offset;
        json["length"] = event.length;
    }
    json["kind"] = row.name;
    json["id"] = event.id;
    for (const auto& [key, value] : event.details)
        std::visit([&json, &key = key](const auto& v) { json[key] = v; }, value);
    file_->add(line_of(json));
}

std::string comment_of(const FaultEvent& event) {
    std::string text = row_of(event.kind).name;
    if (event.message) text += ": message " + std::to_string(*event.message);
    if (event.message) text += ", byte " + std::to_string(event.offset);
    if (event.length > 1) text += ", " + std::to_string(event.length) + " bytes";
    for (const auto& [key, value] : event.details) {
        text += ", " + key + " ";
        if (const auto* number = std::get_if<std::int64_t>(&value)) text += std::to_string(*number);
        if (const auto* number = std::get_if<double>(&value)) text += std::to_string(*number);
        if (const auto* word = std::get_if<std::string>(&value)) text += *word;
    }
    return text;
}

}  // namespace echoloop
