#include "emulator/devices/family/ping/known_drivers.h"
#include "emulator/devices/s500/s500.h"

namespace echoloop::s500 {
namespace {

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<S500>(read_settings(config), config.endpoints);
}

/// One tone over 10 m unless asked otherwise.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    constexpr double default_range = 10;  // m
    if (!(range > 0)) range = default_range;
    State state;
    state.length = static_cast<std::uint32_t>(range * 1e3);
    state.speed_of_sound = static_cast<std::uint32_t>(config.sound_speed * 1e3);
    Shot shot = shot_from(state, read_settings(config));
    shot.ping = step + 1;
    return shot;
}

}  // namespace

Model model() {
    Model m;
    m.name = "s500";
    m.title = "Cerulean S500 echosounder";
    m.protocol = "Ping protocol, TCP, UDP or serial";
    m.default_endpoints = {"tcp-listen://127.0.0.1:51210"};
    m.endpoint_schemes = {"tcp-listen", "udp-listen", "tcp", "udp", "pty", "serial"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "cerulean";
    m.drivers = ping_device::brping_drivers("0.2.3", "S500", {"print(sonar.get_range())"}, true);
    return m;
}

}  // namespace echoloop::s500
