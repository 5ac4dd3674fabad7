#include "tools/view/ticker.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

namespace echoloop::view {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_fields = 48, longest_text = 120, shown_bytes = 24;
constexpr std::size_t fewest_said = 16, most_said = 1024;  // numbers

std::string cut(const std::string& text) {
    return text.size() <= longest_text ? text : text.substr(0, longest_text) + "...";
}

std::string hexadecimal(ByteView bytes) {
    constexpr char digits[] = "0123456789abcdef";
    std::string text;
    for (const auto byte : bytes.first(std::min(bytes.size(), shown_bytes))) {
        const auto value = static_cast<unsigned>(byte);
        text += {digits[value >> 4], digits[value & 15], ' '};
    }
    return text + (bytes.size() > shown_bytes ? "..." : "");
}

Json fields_of(const inspect::Message& message) {
    Json fields = Json::array();
    for (const inspect::Field& field : message.fields) {
        if (fields.size() == most_fields) {
            fields.push_back(
                {"...", std::to_string(message.fields.size() - most_fields) + " more fields", ""});
            break;
        }
        fields.push_back({field.name, cut(field.text), field.unit});
    }
    return fields;
}

}  // namespace

/// Of the longest array; nothing where there is none that is worth a picture.
std::optional<Json> said_of(const std::string& device, const inspect::Message& message) {
    const auto longest = std::ranges::max_element(
        message.fields, {}, [](const inspect::Field& field) { return field.numbers.size(); });
    if (longest == message.fields.end() || longest->numbers.size() < fewest_said) return std::nullopt;
    const std::size_t every = (longest->numbers.size() + most_said - 1) / most_said;
    Json numbers = Json::array();
    for (std::size_t i = 0; i < longest->numbers.size(); i += every) numbers.push_back(longest->numbers[i]);
    return Json{{"device", device},
                {"name", message.name + "." + longest->name},
                {"unit", longest->unit},
                {"numbers", std::move(numbers)}};
}

std::string Ticker::message_of(const std::vector<Passed>& passed, std::size_t left_out) {
    if (passed.empty() && left_out == 0) return "";
    Json rows = Json::array();
    std::map<std::string, Json> said;  // by device and message: the last
    for (const Passed& one : passed) {
        const auto found = families_.find(one.device);
        const inspect::Family* family =
            found == families_.end() ? nullptr : inspect::find_family(found->second);
        const auto add = [&](const inspect::Message& message, ByteView bytes, std::size_t size) {
            Json row{{"n", ++count_},
                     {"unix", one.unix_time},
                     {"device", one.device},
                     {"port", one.port},
                     {"sent", one.sent},
                     {"size", size},
                     {"name", message.name},
                     {"reason", message.reason},
                     {"bytes", hexadecimal(bytes)},
                     {"fields", fields_of(message)}};
            rows.push_back(std::move(row));
            if (!one.sent) return;
            if (auto numbers = said_of(one.device, message))
                said[one.device + "\n" + message.name] = std::move(*numbers);
        };
        const ByteView bytes(one.bytes);
        if (family == nullptr || one.size > one.bytes.size()) {
            add({.name = family == nullptr ? "bytes" : "a long message"}, bytes, one.size);
        } else if (one.packets || family->framing == inspect::Framing::datagram) {
            for (const auto& message : family->decode(bytes))
                add(message, bytes.subspan(message.offset, message.size), message.size);
        } else {
            auto& stream = streams_[{one.device + "\n" + one.port, one.sent}];
            if (!stream) stream = std::make_unique<inspect::StreamDecoder>(family);
            stream->add(bytes, [&](const inspect::Family*, const inspect::Message& message, ByteView part) {
                add(message, part, part.size());
            });
        }
    }
    Json all{{"type", "messages"}, {"left_out", left_out}, {"messages", rows}, {"said", Json::array()}};
    for (auto& [key, numbers] : said) all["said"].push_back(std::move(numbers));
    return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace echoloop::view
