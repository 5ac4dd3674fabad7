#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/reson-7k/reson7k.h"

namespace echoloop::reson7k_device {
namespace {

Address read_listener(const std::vector<Endpoint>& endpoints) {
    if (endpoints.size() != 1)
        throw std::invalid_argument(
            "a 7k sonar has one endpoint, where it listens by TCP and UDP, e.g. "
            "[\"tcp-listen://127.0.0.1:7000\"]");
    const Endpoint& listener = endpoints[0];
    if (listener.scheme != Endpoint::Scheme::tcp_listen)
        throw std::invalid_argument(to_string(listener) + ": the endpoint must be tcp-listen://ADDRESS:7000");
    return {listener.ip, listener.port};
}

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Reson7k>(read_settings(config), read_listener(config.endpoints));
}

Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    const Settings settings = read_settings(config);
    Controls controls = settings.start;
    if (range > 0) controls.range = range;
    return make_shot(controls, settings, static_cast<std::uint32_t>(step + 1));
}

}  // namespace

Model model() {
    Model m;
    m.name = "reson-7k";
    m.title = "Teledyne Reson SeaBat 7k multibeam echosounder";
    m.protocol = "7k records, TCP and UDP 7000";
    m.default_endpoints = {"tcp-listen://127.0.0.1:7000"};
    m.endpoint_schemes = {"tcp-listen"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "reson7k";
    return m;
}

}  // namespace echoloop::reson7k_device
