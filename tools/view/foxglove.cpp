#include "tools/view/foxglove.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/bag/schemas.h"

namespace echoloop::view {
namespace {

constexpr std::size_t most_subscriptions = 1000;
constexpr std::size_t much_waiting = 1 << 20;  // bytes, for one client

FoxgloveFrame text_frame(const nlohmann::ordered_json& json) {
    const auto text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return {false, std::make_shared<const std::string>(text)};
}

/// opcode, subscription, time in ns, message; little endian.
FoxgloveFrame message_frame(std::uint32_t channel, std::uint32_t subscription, std::uint64_t time,
                            const std::string& message) {
    constexpr char message_data = 1;
    std::string bytes(1, message_data);
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(subscription >> (8 * i) & 0xFF);
    for (int i = 0; i < 8; ++i) bytes += static_cast<char>(time >> (8 * i) & 0xFF);
    return {true, std::make_shared<const std::string>(bytes + message), channel};
}

/// A number that a client tells; nothing where it is none.
std::optional<std::uint32_t> number_of(const nlohmann::json& json, const char* key) {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_number_unsigned()) return std::nullopt;
    const auto value = found->get<std::uint64_t>();
    return value <= 0xFFFFFFFFU ? std::optional(static_cast<std::uint32_t>(value)) : std::nullopt;
}

}  // namespace

std::string foxglove_protocol(std::string_view offered) {
    while (!offered.empty()) {
        const auto comma = offered.find(',');
        std::string_view one = offered.substr(0, comma);
        while (one.starts_with(' ')) one.remove_prefix(1);
        while (one.ends_with(' ')) one.remove_suffix(1);
        if (one == "foxglove.sdk.v1" || one == "foxglove.websocket.v1") return std::string(one);
        offered = comma == std::string_view::npos ? "" : offered.substr(comma + 1);
    }
    return "";
}

std::optional<FoxgloveFrame> FoxgloveClient::next() {
    if (waiting_.empty()) return std::nullopt;
    FoxgloveFrame frame = std::move(waiting_.front());
    waiting_.pop_front();
    waiting_bytes_ -= frame.bytes->size();
    return frame;
}

/// Where much waits, what is older of the same channel does no longer.
void FoxgloveClient::push(FoxgloveFrame frame) {
    if (frame.binary && waiting_bytes_ + frame.bytes->size() > much_waiting)
        std::erase_if(waiting_, [&](const FoxgloveFrame& old) {
            const bool replaced = old.binary && old.channel == frame.channel;
            if (replaced) waiting_bytes_ -= old.bytes->size();
            return replaced;
        });
    waiting_bytes_ += frame.bytes->size();
    waiting_.push_back(std::move(frame));
}

Foxglove::Foxglove(bag::About about)
    : topics_(std::move(about), [this](const auto& offer, const auto& make) { take(offer, make); }) {}

std::string Foxglove::advertised(std::uint32_t first) const {
    nlohmann::ordered_json channels = nlohmann::ordered_json::array();
    for (std::uint32_t number = first; number <= channels_.size(); ++number) {
        const Channel& channel = channels_[number - 1];
        channels.push_back({{"id", number},
                            {"topic", channel.topic},
                            {"encoding", "cdr"},
                            {"schemaName", channel.type},
                            {"schemaEncoding", "ros2msg"},
                            {"schema", bag::definition_of(channel.type)}});
    }
    return nlohmann::ordered_json{{"op", "advertise"}, {"channels", channels}}.dump();
}

std::shared_ptr<FoxgloveClient> Foxglove::join() {
    auto client = std::make_shared<FoxgloveClient>();
    client->push(text_frame({{"op", "serverInfo"},
                             {"name", "echoloop"},
                             {"capabilities", nlohmann::json::array()},
                             {"supportedEncodings", nlohmann::json::array()},
                             {"metadata", {{"version", ECHOLOOP_VERSION}}}}));
    if (!channels_.empty()) client->push({false, std::make_shared<const std::string>(advertised(1))});
    clients_.push_back(client);
    return client;
}

void Foxglove::hear(FoxgloveClient& client, const std::string& text) {
    const auto said = nlohmann::json::parse(text, nullptr, false);
    if (!said.is_object() || !said.contains("op")) return;
    const auto list = [&said](const char* key) {
        return said.contains(key) && said[key].is_array() ? said[key] : nlohmann::json::array();
    };
    for (const auto& one : list("subscriptions")) {
        if (said["op"] != "subscribe" || !one.is_object()) continue;
        const auto id = number_of(one, "id"), channel = number_of(one, "channelId");
        if (id && channel && client.subscriptions_.size() < most_subscriptions)
            client.subscriptions_[*channel] = *id;
    }
    for (const auto& one : list("subscriptionIds"))
        if (said["op"] == "unsubscribe")
            std::erase_if(client.subscriptions_, [&](const auto& entry) { return one == entry.second; });
}

void Foxglove::take(const bag::Topics::Offer& offer, const bag::Topics::Make& make) {
    auto known = numbers_.find(offer.topic);
    if (known == numbers_.end()) {
        channels_.push_back({offer.topic, offer.type});
        const auto number = static_cast<std::uint32_t>(channels_.size());
        known = numbers_.emplace(offer.topic, number).first;
        const auto text = std::make_shared<const std::string>(advertised(number));
        for (const auto& client : clients_) client->push({false, text});
    }
    std::optional<std::string> message;  // made once, for the first who wants it
    for (const auto& client : clients_) {
        const auto subscribed = client->subscriptions_.find(known->second);
        if (subscribed == client->subscriptions_.end()) continue;
        if (!message) message = make();
        client->push(message_frame(known->second, subscribed->second, offer.time, *message));
    }
}

}  // namespace echoloop::view
