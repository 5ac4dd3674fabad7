#include "emulator/devices/family/ping/known_drivers.h"
#include "emulator/devices/ping360/ping360.h"
#include "protocols/ping/codec.h"

namespace echoloop::ping360 {
namespace {

constexpr double default_range = 10;  // m

std::unique_ptr<Device> make(const DeviceConfig& config) {
    const Settings settings = read_settings(config);
    return std::make_unique<Ping360>(settings, ping_device::link_ports(config.endpoints, settings.baud));
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

std::vector<Bytes> requests(const DeviceConfig&, std::size_t pings, bool turns) {
    const auto transducer = [](std::uint16_t angle) {
        return ping::encode(ping::Message(ping::Transducer{1, 0, angle, 11, 88, 750, 1200, 1, 0}));
    };
    std::vector<Bytes> words;
    for (std::size_t i = 0; i < pings; ++i)
        words.push_back(transducer(static_cast<std::uint16_t>(turns ? i % circle : 0)));
    return words;
}

std::vector<KnownDriver> drivers() {
    const std::string node = "ros2 run ping360_sonar ping360_node --ros-args -p fallback_emulated:=false -p ";
    const std::string ros2 = "CentraleNantesRobotics ping360_sonar (branch ros2)";
    std::vector<KnownDriver> rows{
        {"ros1",
         "CentraleNantesRobotics ping360_sonar (branch melodic)",
         {"rosrun ping360_sonar ping360_node _device:={port} _baudrate:={rate}"}},
        {"ros2",
         ros2,
         {node + "connection_type:=udp -p udp_address:={host} -p udp_port:={number}"},
         "",
         "udp-listen"},
        {"ros2", ros2, {node + "device:={port} -p baudrate:={rate}"}}};
    const auto python =
        ping_device::brping_drivers("0.2.3", "Ping360", {"print(sonar.transmitAngle(0))"}, false);
    rows.insert(rows.end(), python.begin(), python.end());
    return rows;
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
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "ping";
    m.requests = requests;
    m.drivers = drivers();
    return m;
}

}  // namespace echoloop::ping360
