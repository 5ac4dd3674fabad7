#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/imagenex-deltat/delta_t.h"

namespace echoloop::delta_t {
namespace {

Wiring read_wiring(const std::vector<Endpoint>& endpoints) {
    const char* const example = "udp://127.0.0.1:4040";
    if (endpoints.size() != 1)
        throw std::invalid_argument(
            std::string("a Delta T sends to one host: give exactly one endpoint, e.g. ") + example);
    const Endpoint& e = endpoints[0];
    if (e.scheme != Endpoint::Scheme::udp)
        throw std::invalid_argument(to_string(e) +
                                    ": a Delta T's program speaks first; name the host that is to hear it, "
                                    "udp://ADDRESS:PORT");
    constexpr std::uint32_t loopback = 0x7F000001;
    return {{is_loopback(e.ip) ? loopback : 0, e.local_port()}, {e.ip, e.port}};
}

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<DeltaT>(read_settings(config), read_wiring(config.endpoints));
}

Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    const Settings settings = read_settings(config);
    Controls controls = settings.start;
    if (range > 0) controls.range = static_cast<unsigned>(std::max(1.0, std::round(range)));
    return make_shot(controls, settings.acoustics, step + 1, 0, 0);
}

}  // namespace

Model model() {
    Model m;
    m.name = "imagenex-deltat";
    m.title = "Imagenex 837 Delta T multibeam profiler, its program";
    m.protocol = "83P over UDP, external control by EC";
    m.default_endpoints = {"udp://127.0.0.1:4040"};
    m.endpoint_schemes = {"udp"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "deltat";
    m.drivers = {
        {"ros1",
         "rolker imagenex_deltat",
         {"rosrun imagenex_deltat deltat.py _frame_id:={name}"},
         "it listens on UDP 4040 of every address and sends what it hears on to 192.168.12.8: keep it "
         "in a network of its own"}};
    return m;
}

}  // namespace echoloop::delta_t
