// A Water Linked DVL on the bench over a made-up bottom: lines of JSON are read by nlohmann, sentences by
// hand, never by the project's codec.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {

using namespace std::chrono_literals;
using Json = nlohmann::json;

inline const std::vector<std::string> all_ports{"tcp-listen://127.0.0.1:16171", "tcp-listen://127.0.0.1:80",
                                                "tcp-listen://127.0.0.1:1037", "tcp-listen://127.0.0.1:1038",
                                                "pty:/tmp/echoloop/dvl"};
enum DvlPort : std::size_t { json_port, web_port, pd6_port, pd4_port, line_port };

/// The transducer at a bearing, by the specification's azimuths clockwise from forward: 135, 225, 315, 45 deg
/// are ids 0 to 3.
inline std::size_t id_of(double bearing) {
    const double azimuth = std::fmod(rad_to_deg(bearing) + 360, 360);
    const std::map<int, std::size_t> ids{{135, 0}, {225, 1}, {315, 2}, {45, 3}};
    return ids.at(static_cast<int>(std::lround(azimuth)));
}

inline std::string said(const Send& send) { return {send.bytes.begin(), send.bytes.end()}; }

class DvlBench {
  public:
    explicit DvlBench(const Options& changes = {}, const std::string& model = "dvl-a50", bool noisy = false)
        : bench([&] {
              DeviceConfig config = make_config(*find_model(model), changes);
              config.endpoints = parse_endpoints(all_ports);
              config.unix_start = 1.75e9;
              config.random_key = 7;
              config.effects.set(Effect::sensor_noise, noisy);
              return find_model(model)->make(config);
          }()) {
        note();
    }

    /// Lets time pass; each ping hears a flat bottom `altitude` m below, and none if that is 0.
    void run_to(Time end) {
        while (true) {
            const Time due = bench.ping ? bench.ping->due : Time::max();
            const Time next = std::min(bench.wake, due);
            if (next > end) break;
            if (due <= bench.wake) {
                bench.now = std::max(bench.now, due);
                bench.hear(echo());
            } else {
                bench.run_to(next);
            }
            note();
        }
        bench.run_to(end);
    }
    void say(const std::string& text, std::size_t port = json_port, Address from = host) {
        bench.say(Bytes(text.begin(), text.end()), port, from);
        note();
    }
    /// What a port has said since the last call of this, on all ports.
    std::vector<std::string> texts(std::size_t port) {
        std::vector<std::string> out;
        for (const Send& send : bench.sent())
            if (send.port == port) out.push_back(said(send));
        return out;
    }
    /// Lines of JSON of that type until `end`.
    std::vector<Json> reports(const std::string& type, Time end) {
        bench.sent();
        run_to(end);
        std::vector<Json> out;
        for (const std::string& line : texts(json_port)) {
            const Json json = Json::parse(line);
            if (json.at("type") == type) out.push_back(json);
        }
        return out;
    }
    /// The answers to what a host says by JSON.
    std::vector<Json> ask(const std::string& text) {
        bench.sent();
        say(text);
        std::vector<Json> out;
        for (const std::string& line : texts(json_port)) {
            const Json json = Json::parse(line);
            if (json.at("type") == "response") out.push_back(json);
        }
        return out;
    }
    /// The reply to a line of the serial protocol, without its end.
    std::string ask_line(const std::string& text) {
        bench.sent();
        say(text, line_port, {});
        std::string all;
        for (const std::string& line : texts(line_port)) all += line;
        return all;
    }

    static constexpr Address host{0x7F000001, 50000};
    Bench bench;
    double altitude = 5;  ///< m below the transducers' common point
    std::size_t deaf = 99;
    Vec3 velocity{};  ///< m/s in the world
    Vec3 turning{};   ///< rad/s about the world's z, in z
    double yaw = 0;   ///< rad at the start, to port positive
    double closing_scale = 1;

  private:
    void note() {
        if (!bench.ping || bench.ping->shot.ping == seen_) return;
        seen_ = bench.ping->shot.ping;
        began_ = bench.now;
    }
    Echogram echo() const {
        const Shot& shot = bench.ping->shot;
        Echogram e = echo_of(shot, shot.bins, 0);
        std::fill(e.values.begin(), e.values.end(), 1.0F);
        e.noise_power = 1;
        const double t = to_seconds(began_);
        e.world_from_sonar = {{velocity.x * t, velocity.y * t, velocity.z * t},
                              axis_angle({0, 0, 1}, yaw + turning.z * t)};
        const double time = 2 * altitude / std::cos(deg_to_rad(22.5)) / e.sound_speed;
        const auto first = static_cast<std::size_t>(std::lround(time / shot.bin_interval));
        constexpr float pulse[] = {0.25F, 0.75F, 1, 1, 0.75F, 0.25F};  // as render/acoustics/pulse.h has it
        for (std::size_t beam = 0; beam < shot.beams(); ++beam)
            for (std::size_t bin = 0; bin < std::size(pulse) && first + bin < shot.bins; ++bin)
                if (altitude > 0 && id_of(shot.bearings[beam]) != deaf)
                    e.values[beam * shot.bins + first + bin] = 1e10F * pulse[bin];
        return e;
    }

    std::uint64_t seen_ = 0;
    Time began_{};
};

}  // namespace echoloop::test
