#include "tools/echoloop/validate/driven.h"

#include <algorithm>
#include <stdexcept>

#include "emulator/contract/error.h"
#include "emulator/contract/options.h"
#include "emulator/contract/random_key.h"
#include "emulator/scenario/profile_section.h"
#include "protocols/stream_decoder.h"
#include "tools/capture/messages.h"
#include "tools/capture/open.h"
#include "tools/capture/stream_windows.h"

namespace echoloop::validation {
namespace {

constexpr Address host{0x7F000001, 50000};

const Model& model_of(const Setup& setup) {
    const Model* model = find_model(setup.model);
    if (model == nullptr) throw std::runtime_error("validate: there is no model " + setup.model);
    return *model;
}

DeviceConfig config_of(const Setup& setup) {
    const Model& model = model_of(setup);
    DeviceConfig config;
    config.name = setup.model;
    config.endpoints = parse_endpoints(model.default_endpoints);
    config.options = default_options(model);
    config.profile = own_profile(model);
    config.sound_speed = setup.water.sound_speed.value_or(config.sound_speed);
    config.random_key = random_key(1, setup.model);
    for (const auto& [name, value] : setup.options) config.options.at(name) = value;
    return config;
}

const inspect::Field& field_of(const inspect::Message& message, std::string_view name) {
    const auto found = std::find_if(message.fields.begin(), message.fields.end(),
                                    [&](const inspect::Field& field) { return field.name == name; });
    if (found == message.fields.end())
        throw std::runtime_error("validate: no field " + std::string(name) + " in " + message.name);
    return *found;
}

}  // namespace

Shot plain_shot(const Setup& setup, double range) {
    Shot shot = model_of(setup).default_shot(config_of(setup), 0, range);
    shot.random_key = random_key(1, setup.model);
    return shot;
}

Driven::Driven(const Setup& setup)
    : setup_(setup),
      device_(model_of(setup).make(config_of(setup))),
      family_(inspect::find_family(model_of(setup).family)),
      renderer_(setup.scene, setup.water) {
    take(device_->started(now_));
    for (std::size_t port = 0; port < device_->ports().size(); ++port) {
        device_->reconnected(port);
        take(device_->connected(port, host, now_));
    }
    for (const Bytes& command : setup.once) take(device_->received({0, command, host}, now_));
}

void Driven::take(Actions actions) {
    if (actions.wake) wake_ = *actions.wake;
    if (actions.ping) ping_ = std::move(actions.ping);
    std::move(actions.send.begin(), actions.send.end(), std::back_inserter(sent_));
}

void Driven::await_ping() {
    constexpr int most = 10'000;
    for (int woken = 0; !ping_; ++woken) {
        if (woken == most) throw std::runtime_error("validate: " + setup_.model + " does not ping");
        for (const Bytes& ask : setup_.asks)
            if (!ping_) take(device_->received({0, ask, host}, now_));
        if (ping_) break;
        if (wake_ == Time::max()) throw std::runtime_error("validate: " + setup_.model + " waits for a host");
        now_ = std::max(now_, std::exchange(wake_, Time::max()));
        take(device_->woken(now_));
    }
}

std::vector<inspect::Message> Driven::ping() {
    await_ping();
    Ping ping = std::move(*std::exchange(ping_, std::nullopt));
    ping.shot.random_key = random_key(1, setup_.model);  // as the session does
    const Echogram echogram = renderer_.render(ping.shot, setup_.pose(to_seconds(now_)));
    now_ = std::max(now_, ping.due);
    sent_.clear();
    take(device_->heard(echogram, now_));
    std::vector<inspect::Message> messages;
    inspect::StreamDecoder stream(family_);
    const auto each = [&](const inspect::Family*, const inspect::Message& message, ByteView) {
        if (message.reason.empty()) messages.push_back(message);
    };
    for (const Send& send : sent_) {
        stream.add(send.bytes, each);
        if (family_->framing == inspect::Framing::datagram) stream.finish(each);
    }
    return messages;
}

std::vector<inspect::Message> recorded(const std::filesystem::path& file, std::string_view name) {
    capture::Input input(file.string());
    std::vector<inspect::Message> messages;
    const auto keep = [&](const inspect::Message& message) {
        if (message.name == name && !message.fields.empty()) messages.push_back(message);
    };
    if (const auto reader = capture::open_if_log(input)) {
        capture::MessageSorter sorter(nullptr, [&](const auto&, const auto& message) { keep(message); });
        while (const auto event = reader->next()) sorter.add(*event);
        sorter.finish();
    } else if (const auto* family = inspect::guess_family(input.peek(std::size_t{64} << 10))) {
        capture::decode_windows(input, *family, keep);
    }
    if (messages.empty()) throw StartError(Exit::data, file.string() + ": no message " + std::string(name));
    return messages;
}

bool has_field(const inspect::Message& message, std::string_view name) {
    return std::ranges::any_of(message.fields, [&](const auto& field) { return field.name == name; });
}

double number_in(const inspect::Message& message, std::string_view field) {
    return field_of(message, field).number.value_or(0);
}

const std::vector<double>& numbers_in(const inspect::Message& message, std::string_view field) {
    return field_of(message, field).numbers;
}

}  // namespace echoloop::validation
