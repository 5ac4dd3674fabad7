#include <algorithm>
#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/edgetech-2205/edgetech_2205.h"

namespace echoloop::edgetech_2205 {
namespace {

std::unique_ptr<Device> make(const DeviceConfig& config) {
    const auto listens = [](const Endpoint& endpoint) {
        return endpoint.scheme == Endpoint::Scheme::tcp_listen;
    };
    if (config.endpoints.size() != 2 || !std::ranges::all_of(config.endpoints, listens))
        throw std::invalid_argument(
            "an EdgeTech 2205 has two endpoints, for commands and data, e.g. "
            "[\"tcp-listen://127.0.0.1:1700\", \"tcp-listen://127.0.0.1:1701\"]");
    return std::make_unique<Edgetech2205>(read_settings(config));
}

/// Of the high frequency.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    constexpr std::size_t high = 1;
    Subsystem subsystem;
    if (range > 0) subsystem.range = static_cast<std::uint32_t>(1e3 * range);
    Shot shot = shot_from(subsystem, high, read_settings(config));
    shot.ping = step + 1;
    return shot;
}

}  // namespace

Model model() {
    Model m;
    m.name = "edgetech-2205";
    m.title = "EdgeTech 2205 side-scan sonar";
    m.protocol = "JSF messages: commands and data, each on TCP";
    m.default_endpoints = {"tcp-listen://127.0.0.1:1700", "tcp-listen://127.0.0.1:1701"};
    m.endpoint_schemes = {"tcp-listen"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "edgetech";
    m.drivers = {
        {"dune",
         "DUNE, Sensors/Edgetech2205",
         {"[Sensors.Edgetech2205]", "Enabled = Hardware", "Entity Label = Sidescan", "Activation Time = 120",
          "IPv4 Address = {host}", "TCP Port - Command = {number}", "TCP Port - Data = {number 2}"},
         "goes into the vehicle's .ini file"}};
    return m;
}

}  // namespace echoloop::edgetech_2205
