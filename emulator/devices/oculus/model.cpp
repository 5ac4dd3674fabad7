#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/oculus/oculus.h"
#include "protocols/oculus/codec.h"

namespace echoloop::oculus_device {
namespace {

constexpr std::uint16_t status_udp_port = 52102;
constexpr std::uint32_t loopback_broadcast = 0x7FFFFFFF;  // 127.255.255.255
constexpr double default_range = 10;                      // m

void check_listener(const Endpoint& listener) {
    if (listener.scheme != Endpoint::Scheme::tcp_listen)
        throw std::invalid_argument(to_string(listener) +
                                    ": the first endpoint must be tcp-listen://ADDRESS:52100");
    if (listener.ip == 0)
        throw std::invalid_argument(
            to_string(listener) +
            ": the status tells drivers the address to connect to; name one of this machine's");
}

Address read_status(const Endpoint& status) {
    if (status.scheme != Endpoint::Scheme::udp)
        throw std::invalid_argument(to_string(status) +
                                    ": the second endpoint, for the status, must be udp://ADDRESS:52102");
    return {status.ip, status.port};
}

Wiring read_wiring(const std::vector<Endpoint>& endpoints) {
    if (endpoints.empty() || endpoints.size() > 2)
        throw std::invalid_argument(
            "an Oculus has one or two endpoints, its data port and where its status goes, e.g. "
            "[\"tcp-listen://192.168.2.4:52100\", \"udp://192.168.2.255:52102\"]");
    const Endpoint& listener = endpoints[0];
    check_listener(listener);
    if (endpoints.size() == 1 && !is_loopback(listener.ip))
        throw std::invalid_argument(to_string(listener) +
                                    ": say where the status goes, e.g. \"udp://192.168.2.255:52102\"");
    Wiring wiring{{listener.ip, listener.port}, {loopback_broadcast, status_udp_port}};
    if (endpoints.size() == 2) wiring.status = read_status(endpoints[1]);
    return wiring;
}

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Oculus>(read_settings(config), read_wiring(config.endpoints));
}

/// Low frequency, all beams.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    const Settings settings = read_settings(config);
    Request request;
    request.wish.fire.flags = oculus::flag::range_in_metres | oculus::flag::beams_512;
    request.wish.fire.range = range > 0 ? range : default_range;
    request.wish.fire.sound_speed = config.sound_speed;
    return make_shot(request, make_plan(request, settings, Time{}), settings,
                     static_cast<std::uint32_t>(step + 1));
}

/// The gamma and the flags of a recorded ping: range in m, simple replies, gain assistance; as far as the
/// manifold of the demo scene.
std::vector<Bytes> requests(const DeviceConfig&, std::size_t pings, bool) {
    const oculus::Fire fire{.gamma = 127, .flags = 0x19, .range = 20, .gain = 50};
    return {pings, oculus::encode(oculus::Message(fire))};
}

Model row(const std::string& name, const std::string& title) {
    Model m;
    m.name = name;
    m.title = title;
    m.protocol = "Oculus: status on UDP, fire messages and images on TCP";
    m.default_endpoints = {"tcp-listen://127.0.0.1:52100", "udp://127.255.255.255:52102"};
    m.endpoint_schemes = {"tcp-listen"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "oculus";
    m.requests = requests;
    m.drivers = {{"ros1",
                  "ENSTA Bretagne oculus_ros",
                  {"rosrun oculus_sonar oculus_sonar_node"},
                  "it takes the first sonar whose status it hears on UDP 52102, so emulate one; APL's "
                  "oculus_sonar_driver does, too, and wants option gain_word f32"},
                 {"ros2",
                  "ENSTA Bretagne oculus_ros2",
                  {"ros2 launch oculus_ros2 default.launch.py"},
                  "it takes the first sonar whose status it hears on UDP 52102, so emulate one"}};
    return m;
}

}  // namespace

std::vector<Model> models() {
    return {row("oculus-m370s", "Blueprint Subsea Oculus M370s imaging sonar"),
            row("oculus-m750d", "Blueprint Subsea Oculus M750d imaging sonar"),
            row("oculus-m1200d", "Blueprint Subsea Oculus M1200d imaging sonar"),
            row("oculus-m3000d", "Blueprint Subsea Oculus M3000d imaging sonar")};
}

}  // namespace echoloop::oculus_device
