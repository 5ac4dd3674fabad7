#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/kongsberg-kmall/kongsberg.h"

namespace echoloop::kongsberg_kmall {
namespace {

Address address_of(const Endpoint& endpoint, Endpoint::Scheme scheme, const char* what) {
    if (endpoint.scheme != scheme)
        throw std::invalid_argument(to_string(endpoint) + ": " + what + " must be " +
                                    std::string(scheme_name(scheme)) + "://ADDRESS:PORT");
    return {endpoint.ip, endpoint.port};
}

Wiring read_wiring(const std::vector<Endpoint>& endpoints) {
    if (endpoints.size() != 2 && endpoints.size() != 3)
        throw std::invalid_argument(
            "a Kongsberg multibeam has two endpoints, where commands arrive and where datagrams go, and a "
            "third "
            "where its controller's texts are to go, e.g. [\"udp-listen://127.0.0.1:14002\", "
            "\"udp://127.0.0.1:6020\", \"udp://127.0.0.1:4002\"]");
    Wiring wiring{address_of(endpoints[0], Endpoint::Scheme::udp_listen, "the endpoint for commands"),
                  address_of(endpoints[1], Endpoint::Scheme::udp, "the endpoint of datagrams")};
    if (endpoints.size() == 3)
        wiring.controller = address_of(endpoints[2], Endpoint::Scheme::udp, "the endpoint of texts");
    return wiring;
}

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Kongsberg>(read_settings(config), read_wiring(config.endpoints));
}

Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    Settings settings = read_settings(config);
    if (range > 0) settings.range = range;
    return make_shot(settings, step + 1);
}

}  // namespace

Model model() {
    Model m;
    m.name = "kongsberg-kmall";
    m.title = "Kongsberg EM multibeam echosounder, KMALL";
    m.protocol = "KMALL over UDP, commands and status as text";
    m.default_endpoints = {"udp-listen://127.0.0.1:14002", "udp://127.0.0.1:6020"};
    m.endpoint_schemes = {"udp-listen"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "kmall";
    m.sends = {{"datagrams", 1}, {"texts", 2}};
    m.drivers = {{"ros1",
                  "kongsberg_em_driver",
                  {"kmall_connection:", "  udp_address: \"{host 2}\"", "  udp_rx_port: {number 2}",
                   "  udp_tx_port: 6021", "kctrl_connection:", "  udp_address: \"{host}\"",
                   "  udp_rx_port: {number 3}", "  udp_tx_port: {number}", "sounder_name: EM2040_40"},
                  "goes into launch/kongsberg_2040.yaml; start it with roslaunch kongsberg_em_driver "
                  "kongsberg_2040.launch"}};
    return m;
}

}  // namespace echoloop::kongsberg_kmall
