#include "tools/echoloop/fault_answer.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "emulator/contract/error.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/json_line.h"

namespace echoloop::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Discarded if it is no JSON, or deeper than any answer of a run: writing it back calls itself once a level.
Json parsed(std::string_view text) {
    constexpr int deepest = 8;
    bool too_deep = false;
    const auto keep = [&too_deep](int depth, Json::parse_event_t, Json&) {
        too_deep = too_deep || depth > deepest;
        return depth <= deepest;
    };
    Json json = Json::parse(text, keep, false);
    return too_deep ? Json(Json::value_t::discarded) : json;
}

/// For a terminal, which would obey control characters.
std::string shown(std::string text) {
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; };
    std::ranges::replace_if(text, is_control, '?');
    return text;
}
std::string shown(const Json& value) {
    return shown(value.is_string() ? value.get<std::string>() : line_of(value));
}

std::string member(const Json& object, const char* key) {
    return object.contains(key) ? shown(object[key]) : "";
}

std::string text_of_fault(const Json& fault) {
    char number[32];
    std::snprintf(number, sizeof number, "%4d  ", fault.value("id", 0));
    std::string text = number;
    for (const auto& [key, value] : fault.items())
        if (key != "id")
            text += (key == "device" || key == "kind" ? "" : shown(key) + "=") + shown(value) + " ";
    return text + "\n";
}

std::string text_of_device(const Json& device) {
    std::string text = padded(member(device, "name"), 16);
    for (const auto& [key, value] : device.items())
        if (key != "name" && key != "faults") text += shown(line_of(value)) + " " + shown(key) + "  ";
    text += "\n";
    for (const auto& [kind, made] : device.at("faults").items())
        text += padded("", 16) + shown(made) + " " + shown(kind) + "\n";
    return text;
}

std::string reply_text(const Json& answer) {
    std::string text;
    if (answer.contains("id")) {
        const std::string id = std::to_string(answer.value("id", 0));
        text += "fault " + id + "; `clear " + id + "` ends it\n";
    }
    if (answer.contains("cleared"))
        text += counted(answer.at("cleared").get<std::uint64_t>(), "fault") + " cleared\n";
    if (answer.contains("faults")) {
        const auto& faults = answer["faults"].get_ref<const Json::array_t&>();
        for (const Json& fault : faults) text += text_of_fault(fault.get_ref<const Json::object_t&>());
        if (faults.empty()) text += "no faults\n";
    }
    if (answer.contains("devices"))
        for (const Json& device : answer["devices"].get_ref<const Json::array_t&>())
            text += text_of_device(device.get_ref<const Json::object_t&>());
    return text;
}

}  // namespace

bool is_answer(std::string_view answer) { return parsed(answer).is_object(); }

bool is_welcome(std::string_view answer) {
    const Json json = parsed(answer);
    const auto ok = json.is_object() ? json.find("ok") : json.end();
    return ok != json.end() && *ok == true;
}

std::string text_of_answer(std::string_view answer) {
    if (answer.empty()) throw StartError(Exit::io, "the run ended without an answer, or says nothing");
    const Json json = parsed(answer);
    try {
        if (json.is_object() && !json.value("ok", false))
            throw StartError(Exit::data, shown(json.value("error", "refused")));
        if (json.is_object()) return reply_text(json);
    } catch (const Json::exception&) {  // a value of another kind than a run's
    }
    throw StartError(Exit::io, "the answer is not from a run; is SOCKET the place given to its --control?");
}

}  // namespace echoloop::cli
