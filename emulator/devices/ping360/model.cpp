#include <stdexcept>

#include "emulator/devices/ping360/ping360.h"
#include "emulator/endpoint.h"

namespace echoloop::ping360 {
namespace {

constexpr std::uint16_t discovery_port = 30303;
constexpr double default_range = 10;  // m

std::unique_ptr<Device> make(const DeviceConfig& config) {
    const Settings settings = read_settings(config);
    std::vector<Port> ports = ping_device::link_ports(config.endpoints, settings.baud);
    if (!settings.discovery.empty()) {
        const Endpoint at =
            parse_endpoint("udp-listen://" + settings.discovery + ":" + std::to_string(discovery_port));
        ports.push_back({"discovery", Port::Kind::datagram, {at.ip, at.port}, true});
    }
    return std::make_unique<Ping360>(settings, std::move(ports));
}

/// Boot settings with 1200 samples over the range.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    if (!(range > 0)) range = default_range;
    ping::DeviceData d = boot_settings();
    d.number_of_samples = 1200;
    Shot shot = shot_from(d, static_cast<int>(step % circle), read_settings(config));
    shot.bin_interval = 2 * range / config.sound_speed / static_cast<double>(shot.bins);
    shot.ping = step + 1;
    return shot;
}

}  // namespace

Model model() {
    Model m;
    m.name = "ping360";
    m.title = "Blue Robotics Ping360 mechanical scanning sonar";
    m.protocol = "Ping protocol, serial or UDP";
    m.default_endpoints = {"pty:/tmp/echoloop/ping360"};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen", "tcp", "udp-listen", "udp"};
    m.turn_steps = circle;
    m.options = option_table();
    m.figures = figure_table();
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    return m;
}

}  // namespace echoloop::ping360
