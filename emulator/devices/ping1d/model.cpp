#include "emulator/devices/family/ping/known_drivers.h"
#include "emulator/devices/ping1d/ping1d.h"
#include "protocols/ping/codec.h"

namespace echoloop::ping1d {
namespace {

std::unique_ptr<Device> make(const DeviceConfig& config) {
    const Settings settings = read_settings(config);
    return std::make_unique<Ping1d>(settings, ping_device::link_ports(config.endpoints, settings.baud));
}

Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    const Settings settings = read_settings(config);
    State state = settings.power_up;
    state.speed_of_sound = static_cast<std::uint32_t>(config.sound_speed * 1e3);
    if (range > 0) state.length = static_cast<std::uint32_t>(range * 1e3);
    Shot shot = shot_from(state, settings);
    shot.ping = step + 1;
    return shot;
}

std::vector<Bytes> requests(const DeviceConfig&, std::size_t pings, bool) {
    constexpr std::uint16_t profile = 1300;
    return {pings, ping::encode(ping::Message(ping::GeneralRequest{profile}))};
}

}  // namespace

Model model() {
    Model m;
    m.name = "ping1d";
    m.title = "Blue Robotics Ping1D / Ping2 echosounder";
    m.protocol = "Ping protocol, serial or UDP";
    m.default_endpoints = {"pty:/tmp/echoloop/ping1d"};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen", "tcp", "udp-listen", "udp"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "ping";
    m.requests = requests;
    m.drivers = ping_device::brping_drivers("0.1.5", "Ping1D", {"print(sonar.get_distance())"}, false);
    m.drivers.push_back(range_finder_in_sitl("23"));
    m.drivers.push_back({"ros1",
                         "robbal46 ping1d_ros",
                         {"rosrun ping1d_ros ping1d_node.py _serial_port:={port} _baud_rate:={rate}"}});
    m.drivers.push_back({"ros2",
                         "tasada038 ping_sonar_ros",
                         {"ros2 run ping_sonar_ros ping1d_node --ros-args -p port:={port}"},
                         "it opens the port at 115200 bit/s"});
    return m;
}

}  // namespace echoloop::ping1d
