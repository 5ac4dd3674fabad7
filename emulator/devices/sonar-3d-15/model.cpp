#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/sonar-3d-15/sonar.h"

namespace echoloop::sonar_3d_15 {
namespace {

Wiring read_wiring(const std::vector<Endpoint>& endpoints) {
    if (endpoints.empty() || endpoints.size() > 2)
        throw std::invalid_argument(
            "a Sonar 3D-15 has its HTTP port and, if images go to one host from the start, that host's: "
            "[\"tcp-listen://192.168.194.96:80\", \"udp://192.168.194.1:4747\"]");
    const Endpoint& listener = endpoints[0];
    if (listener.scheme != Endpoint::Scheme::tcp_listen)
        throw std::invalid_argument(to_string(listener) +
                                    ": the first endpoint must be tcp-listen://ADDRESS:80");
    Wiring wiring{{listener.ip, listener.port}, {}, 0};
    if (endpoints.size() == 1) return wiring;
    const Endpoint& host = endpoints[1];
    if (host.scheme != Endpoint::Scheme::udp)
        throw std::invalid_argument(to_string(host) +
                                    ": the second endpoint, for the images, must be udp://ADDRESS:PORT");
    wiring.unicast_ip = host.host;
    wiring.unicast_port = host.port;
    return wiring;
}

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Sonar>(read_settings(config), read_wiring(config.endpoints));
}

Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    const Settings settings = read_settings(config);
    State state = settings.start;
    if (range > 0) state.range_max = range;
    if (state.range_max <= state.range_min) state.range_min = 0;
    const View view = make_view(settings.mode(state.high), settings.first_row_up);
    const Plan plan = make_plan(state, config.sound_speed, settings);
    return make_shot(plan, view, settings, step + 1);
}

}  // namespace

Model model() {
    Model m;
    m.name = "sonar-3d-15";
    m.title = "Water Linked Sonar 3D-15 imaging sonar";
    m.protocol = "Range Image Protocol by UDP, HTTP";
    m.default_endpoints = {"tcp-listen://127.0.0.1:8080"};
    m.endpoint_schemes = {"tcp-listen"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "sonar3d";
    m.drivers = {{"ros2",
                  "Water Linked Sonar-3D-15-ROS-driver",
                  {"ros2 run sonar3d sonar_publisher --ros-args -p IP:={host}"},
                  "it asks on port 80 and reads RIP1 only: endpoints [\"tcp-listen://ADDRESS:80\"], option "
                  "packets RIP1"},
                 {"python",
                  "wlsonar (PyPI)",
                  {"import wlsonar", "sonar = wlsonar.Sonar3D(\"{host}\", port={number})",
                   "print(sonar.get_status())"}}};
    return m;
}

}  // namespace echoloop::sonar_3d_15
