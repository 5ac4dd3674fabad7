// What device tests share: a device on a bench, driven by literal bytes and times, with echoes made up by the
// test.
#pragma once

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emulator/contract/device.h"
#include "emulator/contract/model.h"
#include "emulator/contract/options.h"
#include "emulator/scenario/profile_section.h"

namespace echoloop::test {

inline Bytes from_hex(const std::string& text) {
    Bytes bytes;
    std::string digits;
    for (char c : text)
        if (c != ' ') digits += c;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
        bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
    return bytes;
}

inline std::string to_hex(ByteView bytes) {
    std::string text;
    char digits[3];
    for (std::uint8_t byte : bytes) {
        std::snprintf(digits, sizeof digits, "%02x", byte);
        text += digits;
    }
    return text;
}

/// An echogram for a shot: silence with one echo of `power` in bin `bin` of every beam.
inline Echogram echo_of(const Shot& shot, std::size_t bin, float power) {
    Echogram echogram;
    echogram.shot = shot;
    echogram.sound_speed = 1500;
    echogram.values.assign(shot.beams() * shot.bins, 0.0F);
    echogram.truth.resize(shot.beams());
    if (bin < shot.bins)
        for (std::size_t beam = 0; beam < shot.beams(); ++beam)
            echogram.values[beam * shot.bins + bin] = power;
    return echogram;
}

inline bool is_sonar(const Model& model) { return model.default_shot != nullptr; }

/// A model's device with its own profile and default options, some of them changed. Its sensors and its timer
/// are exact; variation_test.cpp has them as they are in life.
inline DeviceConfig make_config(const Model& row, const Options& changes = {}) {
    DeviceConfig config;
    config.name = "under test";
    config.endpoints = parse_endpoints(row.default_endpoints);
    config.options = default_options(row);
    config.profile = own_profile(row);
    config.effects.set(Effect::sensor_noise, false).set(Effect::ping_jitter, false);
    for (const auto& [name, value] : changes) config.options.at(name) = value;
    return config;
}

inline std::unique_ptr<Device> make_device(const std::string& model, std::vector<std::string> endpoints = {},
                                           const Options& changes = {}) {
    const Model& row = *find_model(model);
    DeviceConfig config = make_config(row, changes);
    if (!endpoints.empty()) config.endpoints = parse_endpoints(endpoints);
    return row.make(config);
}

/// Plays the session: keeps the time, the pending wake-up and ping, and everything the device has sent.
class Bench {
  public:
    explicit Bench(std::unique_ptr<Device> device) : device_(std::move(device)) {
        take(device_->started(now));
    }

    void say(ByteView bytes, std::size_t port = 0, Address from = {}) {
        take(device_->received({port, bytes, from}, now));
    }
    void say(const std::string& hex, std::size_t port = 0, Address from = {}) {
        say(from_hex(hex), port, from);
    }

    /// One of several drivers of a port comes, and goes.
    void connect(std::size_t port, Address peer) { take(device_->connected(port, peer, now)); }
    void disconnect(std::size_t port, Address peer) { take(device_->disconnected(port, peer, now)); }

    /// Lets time pass to `end`; wake-ups and echoes come when they are due. Echoes are silence unless `echo`
    /// says so.
    void run_to(Time end) {
        while (true) {
            const Time ping_due = ping ? ping->due : Time::max();
            const Time next = std::min(wake, ping_due);
            if (next > end) break;
            now = next;
            if (ping_due <= wake)
                hear();
            else {
                wake = Time::max();
                take(device_->woken(now));
            }
        }
        now = end;
    }

    /// Delivers the echogram of the pending ping at its time.
    void hear() { hear(echo_of(ping->shot, echo_bin, echo_power)); }
    void hear(const Echogram& echogram) {
        const Ping done = *ping;
        ping.reset();
        now = std::max(now, done.due);
        shots.push_back(done.shot);
        take(device_->heard(echogram, now));
    }

    Device& device() { return *device_; }
    /// Everything sent since the last call.
    std::vector<Send> sent() { return std::exchange(sent_, {}); }

    Time now{}, wake = Time::max();
    std::optional<Ping> ping;
    std::vector<Shot> shots;  ///< of the pings heard so far
    std::size_t echo_bin = static_cast<std::size_t>(-1);
    float echo_power = 0;
    /// Where the device is at a time.
    std::function<Located(Time)> where = [](Time time) { return Located{time, {}, {}}; };

  private:
    void take(Actions actions) {
        for (Send& send : actions.send) sent_.push_back(std::move(send));
        if (actions.wake) wake = *actions.wake;
        if (actions.ping) ping = std::move(actions.ping);
        if (actions.locate.empty()) return;
        std::vector<Located> places;
        for (const Time time : actions.locate) places.push_back(where(time));
        take(device_->located(places, now));
    }

    std::unique_ptr<Device> device_;
    std::vector<Send> sent_;
};

}  // namespace echoloop::test
